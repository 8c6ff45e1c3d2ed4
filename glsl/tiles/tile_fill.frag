// SPDX-License-Identifier: MIT
// Open values, for tiles that no other pass draws.
// out o_open  accessibility 1; in a paired map beside a quantity of distance that no pass reads. As a difference (rays.frag) it
//             only ever reaches pixels that are 1 already, and leaves them so

out vec4 o_open;

void main()
{
    o_open = vec4(1.0);
}
