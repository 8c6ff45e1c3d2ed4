/* SPDX-License-Identifier: MIT
 *
 * Compiles and links the programs of the scene's draw passes.
 */
#include "program.h"

#include "gl.h"
#include "scene_shaders.h"

#include <stdio.h>
#include <string.h>

static const struct {
    unsigned bit;
    const char *macro;
} variant_macros[] = {
    {VARIANT_TEXTURED, "TEXTURED"},
    {VARIANT_COLORED, "COLORED"},
    {VARIANT_MASKED, "MASKED"},
    {VARIANT_LIT, "LIT"},
    {VARIANT_DOUBLE_SIDED, "DOUBLE_SIDED"},
    {VARIANT_BLENDED, "BLENDED"},
    {VARIANT_NORMAL_MAPPED, "NORMAL_MAPPED"},
    {VARIANT_REFLECTIVE, "REFLECTIVE"},
    {VARIANT_ROUGHNESS_MAPPED, "ROUGHNESS_MAPPED"},
    {VARIANT_BAKED, "BAKED"},
    {VARIANT_EMISSIVE, "EMISSIVE"},
    {VARIANT_EMISSION_MAPPED, "EMISSION_MAPPED"},
    {VARIANT_SHADOWED, "SHADOWED"},
    {VARIANT_LIGHTS, "LIGHTS"},
    {VARIANT_SPECULAR_OCCLUSION, "SPECULAR_OCCLUSION"},
    {VARIANT_MULTI_BOUNCE, "MULTI_BOUNCE"},
    {VARIANT_BASE_MAPPED, "BASE_MAPPED"},
    {VARIANT_BEHIND, "BEHIND"},
    {VARIANT_ENVIRONMENT, "ENVIRONMENT"},
    {VARIANT_FLAT, "FLAT"},
    {VARIANT_MORE_UVS, "MORE_UVS"},
    {VARIANT_MOVES, "MOVES"},
    {VARIANT_BENT, "BENT"},
};

static const struct {
    const char *name;
    size_t offset; /* of its location in draw_program */
} uniforms[] = {
    {"u_view_from_world", offsetof(draw_program, view_from_world)},
    {"u_clip_from_view", offsetof(draw_program, clip_from_view)},
    {"u_normal_view_from_world", offsetof(draw_program, normal_view_from_world)},
    {"u_last_view_from_world", offsetof(draw_program, last_view_from_world)},
    {"u_last_clip_from_view", offsetof(draw_program, last_clip_from_view)},
    {"u_base_color_uv", offsetof(draw_program, base_color_uv)},
    {"u_normal_uv", offsetof(draw_program, normal_uv)},
    {"u_metallic_roughness_uv", offsetof(draw_program, metallic_roughness_uv)},
    {"u_occlusion_uv", offsetof(draw_program, occlusion_uv)},
    {"u_emission_uv", offsetof(draw_program, emission_uv)},
    {"u_handedness", offsetof(draw_program, handedness)},
    {"u_normal_scale", offsetof(draw_program, normal_scale)},
    {"u_metallic_roughness", offsetof(draw_program, metallic_roughness)},
    {"u_occlusion_strength", offsetof(draw_program, occlusion_strength)},
    {"u_emission", offsetof(draw_program, emission)},
    {"u_base_color", offsetof(draw_program, base_color)},
    {"u_alpha_cutoff", offsetof(draw_program, alpha_cutoff)},
    {"u_ambient", offsetof(draw_program, ambient)},
    {"u_intensity", offsetof(draw_program, intensity)},
    {"u_ambient_tilt", offsetof(draw_program, ambient_tilt)},
    {"u_up_view", offsetof(draw_program, up_view)},
    {"u_is_orthographic", offsetof(draw_program, is_orthographic)},
    {"u_shadow_from_world", offsetof(draw_program, shadow_from_world)},
    {"u_lights", offsetof(draw_program, lights)},
    {"u_light_count", offsetof(draw_program, light_count)},
    {"u_sky_from_clip", offsetof(draw_program, sky_from_clip)},
    {"u_sky", offsetof(draw_program, sky)},
    {"u_sky_tilt", offsetof(draw_program, sky_tilt)},
    {"u_irradiance", offsetof(draw_program, irradiance)},
    {"u_sky_from_view", offsetof(draw_program, sky_from_view)},
    {"u_origin", offsetof(draw_program, origin)},
    {"u_directional", offsetof(draw_program, directional)},
    {"u_to_light_view", offsetof(draw_program, to_light_view)},
    {"u_pixel_uv", offsetof(draw_program, pixel_uv)},
    {"u_depth_offset", offsetof(draw_program, depth_offset)},
    {"u_scale", offsetof(draw_program, scale)},
    {"u_bias", offsetof(draw_program, bias)},
    {"u_red_only", offsetof(draw_program, red_only)},
    {"u_numerator", offsetof(draw_program, numerator)},
    {"u_denominator", offsetof(draw_program, denominator)},
    {"u_far_depth", offsetof(draw_program, far_depth)},
    {"u_offset", offsetof(draw_program, offset)},
};

static const struct {
    const char *name;
    int unit;
} samplers[] = {
    {"u_base_color_map", UNIT_BASE_COLOR},
    {"u_ambient_map", UNIT_AMBIENT},
    {"u_first_depth_map", UNIT_FIRST_DEPTH},
    {"u_shadow_map", UNIT_SHADOW},
    {"u_normal_map", UNIT_NORMAL},
    {"u_metallic_roughness_map", UNIT_METALLIC_ROUGHNESS},
    {"u_occlusion_map", UNIT_OCCLUSION},
    {"u_emission_map", UNIT_EMISSION},
    {"u_environment_map", UNIT_ENVIRONMENT},
    {"u_map", UNIT_MAP},
    {"u_depth_map", UNIT_MAP},
};

static void say_failure(const char *what, const char *step, const char *log, failure *fault)
{
    fault_set(fault, "%s, %s: %s", what, step, *log ? log : "the driver gives no reason");
}

static unsigned compile(GLenum type, const char *macros, const char *const shared[3], const char *source,
                        const char *what, failure *fault)
{
    /* #version has to come first; it is the first line of each shader file. */
    size_t version_length = strcspn(source, "\n") + 1;
    /* Line numbers in the driver's log are then those of the file. */
    const char *parts[] = {source, macros, shared[0], shared[1], shared[2], "#line 2\n", source + version_length};
    const GLint lengths[] = {(GLint)version_length, -1, -1, -1, -1, -1, -1};

    unsigned shader = gl.CreateShader(type);
    gl.ShaderSource(shader, 7, parts, lengths);
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        char log[2048] = "";
        gl.GetShaderInfoLog(shader, sizeof log, NULL, log);
        say_failure(what, type == GL_VERTEX_SHADER ? "vertex shader" : "fragment shader", log, fault);
        gl.DeleteShader(shader);
        return 0;
    }
    return shader;
}

static bool link(unsigned program, const char *what, failure *fault)
{
    gl.LinkProgram(program);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[2048] = "";
        gl.GetProgramInfoLog(program, sizeof log, NULL, log);
        say_failure(what, "link", log, fault);
    }
    return linked;
}

static void look_up(draw_program *p)
{
    for (size_t i = 0; i < sizeof uniforms / sizeof uniforms[0]; i++) {
        int location = gl.GetUniformLocation(p->name, uniforms[i].name);
        memcpy((char *)p + uniforms[i].offset, &location, sizeof location);
    }
    gl.UseProgram(p->name);
    for (size_t i = 0; i < sizeof samplers / sizeof samplers[0]; i++)
        gl.Uniform1i(gl.GetUniformLocation(p->name, samplers[i].name), samplers[i].unit);
    gl.UseProgram(0);
}

bool draw_program_build(draw_program *p, const char *what, const char *vertex_source, const char *shared_source,
                        const char *fragment_source, unsigned variant, failure *fault)
{
    char macros[768] = "";
    size_t length = 0;
    for (size_t i = 0; i < sizeof variant_macros / sizeof variant_macros[0]; i++)
        length += (size_t)snprintf(macros + length, sizeof macros - length, "#define %s %d\n", variant_macros[i].macro,
                                   (variant & variant_macros[i].bit) != 0);

    const char *const none[3] = {"", "", ""};
    const char *const shared[3] = {shared_source, variant & VARIANT_ENVIRONMENT ? shader_environment_glsl : "",
                                   variant & VARIANT_BENT ? shader_bent_glsl : ""};
    unsigned vertex = compile(GL_VERTEX_SHADER, macros, none, vertex_source, what, fault);
    if (!vertex)
        return false;
    unsigned fragment = compile(GL_FRAGMENT_SHADER, macros, shared, fragment_source, what, fault);
    if (!fragment) {
        gl.DeleteShader(vertex);
        return false;
    }
    p->name = gl.CreateProgram();
    gl.AttachShader(p->name, vertex);
    gl.AttachShader(p->name, fragment);
    /* The program keeps them for as long as it lives. */
    gl.DeleteShader(vertex);
    gl.DeleteShader(fragment);
    if (!link(p->name, what, fault)) {
        gl.DeleteProgram(p->name);
        p->name = 0;
        return false;
    }
    look_up(p);
    return true;
}
