// SPDX-License-Identifier: MIT
// Open values, for tiles that no other pass draws.
// out o_open  accessibility 1; in a paired map beside a quantity of distance that no pass reads

out vec4 o_open;

void main()
{
    o_open = vec4(1.0);
}
