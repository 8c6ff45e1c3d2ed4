// SPDX-License-Identifier: MIT
// Accessibility for the blender, which multiplies it into the colour of the framebuffer.
// in  v_uv           0..1
// in  u_ambient_map  accessibility, linearly sampled
// out o_color        accessibility in rgb; alpha is masked by the blend function

in vec2 v_uv;
uniform sampler2D u_ambient_map;
out vec4 o_color;

void main()
{
    o_color = vec4(texture(u_ambient_map, v_uv).rrr, 1.0);
}
