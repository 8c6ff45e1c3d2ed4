/* SPDX-License-Identifier: MIT
 *
 * A frame as renderers of light have it: opaque geometry, glass, fog, tone mapping. Occlusion is applied where the
 * command line says, so that pictures show which place is right; a renderer that can apply only at the end keeps glass
 * free of it by a strength texture.
 *   dropin-order [--apply opaque|glass|fog|tone-mapping] [--strength full|none|opacity] [--fog] [--truth FILE.pfm]
 *                [--frames N] [--picture FILE.ppm] [--no-ao]
 */
#include "support.h"

#include <cglm/cglm.h>
#include <glssao/glssao.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Boxes, then two panes of glass: in front of contacts, and behind one box but before another. */
static const char *const scene_texts[2] = {
    "#version 330\n"
    "const vec3 boxes[18] = vec3[](vec3(0.0, -0.1, 0.0), vec3(4.0, 0.1, 4.0), vec3(0.35),\n" /* center, */
    "                              vec3(-0.8, 0.6, 0.0), vec3(0.6), vec3(0.8, 0.3, 0.12),\n" /* half size, */
    "                              vec3(0.5, 0.4, 0.3), vec3(0.4), vec3(0.2, 0.45, 0.8),\n"  /* color */
    "                              vec3(0.3, 0.9, -1.2), vec3(0.9, 0.9, 0.3), vec3(0.45, 0.6, 0.3),\n"
    "                              vec3(0.75, 0.65, -0.6), vec3(0.65, 0.6, 0.0), vec3(0.25, 0.5, 0.45),\n"
    "                              vec3(-0.1, 0.45, 1.0), vec3(0.75, 0.4, 0.0), vec3(0.25, 0.5, 0.45));\n"
    "uniform mat4 clip_from_world; uniform int first; out vec3 normal, color;\n"
    "void main() {\n"
    "    int face = first + gl_InstanceID, box = face / 6 * 3, axis = face / 2 % 3;\n" /* an instance is a face */
    "    vec3 p = vec3(gl_VertexID % 2, gl_VertexID / 2, face % 2) * 2.0 - 1.0;\n"
    "    normal = vec3(0.0, 0.0, p.z);\n"
    "    for (int i = 0; i < axis; ++i) { p = p.zxy; normal = normal.zxy; }\n"
    "    color = boxes[box + 2];\n"
    "    gl_Position = clip_from_world * vec4(boxes[box] + boxes[box + 1] * p, 1.0);\n"
    "}\n",
    "#version 330\nin vec3 normal, color; uniform float opacity, keep_out;\n"
    "layout(location = 0) out vec4 o_light; layout(location = 1) out vec4 o_strength;\n"
    "void main() {\n"
    "    o_light = vec4(color * (0.6 + 0.6 * max(dot(normal, vec3(0.36, 0.8, 0.48)), 0.0)), opacity);\n"
    "    o_strength = vec4(0.0, 0.0, 0.0, keep_out);\n" /* blended: multiplies what is there by 1 - keep_out */
    "}\n"};

static const char whole_picture[] = "#version 330\nout vec2 uv;\n"
                                    "void main() {\n"
                                    "    uv = vec2(gl_VertexID % 2, gl_VertexID / 2) * 2.0;\n"
                                    "    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);\n"
                                    "}\n";
static const char fog_text[] = "#version 330\nin vec2 uv; uniform sampler2D map; out vec4 o_light;\n"
                               "void main() {\n" /* planes at 0.1 and 50 */
                               "    float distance = 10.0 / (100.2 - 99.8 * (2.0 * texture(map, uv).r - 1.0)) * 2.0;\n"
                               "    o_light = vec4(0.5, 0.55, 0.65, 1.0 - exp(-0.25 * max(distance - 3.0, 0.0)));\n"
                               "}\n";
static const char tone_text[] = "#version 330\nin vec2 uv; uniform sampler2D map; out vec4 o_display;\n"
                                "void main() {\n"
                                "    vec3 light = texture(map, uv).rgb, mapped = light / (0.6 + light);\n"
                                "    o_display = vec4(pow(min(mapped, 1.0), vec3(1.0 / 2.2)), 1.0);\n"
                                "}\n";
static const char multiply_text[] = "#version 330\nin vec2 uv; uniform sampler2D map; out vec4 o_factor;\n"
                                    "void main() { o_factor = texture(map, uv).rrrr; }\n";

typedef struct place {
    const char *apply, *strength, *truth;
    bool fog;
} place;

static place read_place(int argc, char **argv)
{
    place p = {.apply = "opaque", .strength = "full"};
    for (int i = 1; i < argc; ++i) {
        const char *next = i + 1 < argc ? argv[i + 1] : NULL;
        if (next && strcmp(argv[i], "--apply") == 0)
            p.apply = next;
        else if (next && strcmp(argv[i], "--strength") == 0)
            p.strength = next;
        else if (next && strcmp(argv[i], "--truth") == 0)
            p.truth = next;
        else if (strcmp(argv[i], "--fog") == 0)
            p.fog = true;
    }
    return p;
}

static GLuint make_program(const char *vertex, const char *fragment)
{
    const char *const texts[2] = {vertex, fragment};
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
        GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        glShaderSource(shader, 1, &texts[i], NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    return program;
}

static GLuint make_texture(GLint format, GLenum components, int width, int height, const void *texels)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, components,
                 components == GL_DEPTH_COMPONENT ? GL_UNSIGNED_INT : GL_FLOAT, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

/* Accessibility from a file of this machine's byte order, as glssao-render --ao writes it. */
static GLuint read_truth(const char *path, int width, int height)
{
    int w = 0, h = 0;
    float scale = 0.0f;
    float *texels = malloc((size_t)(width * height) * sizeof *texels);
    FILE *file = fopen(path, "rb");
    const bool ok = texels && file && fscanf(file, "Pf %d %d %f", &w, &h, &scale) == 3 && w == width && h == height &&
                    fgetc(file) == '\n' && fread(texels, sizeof *texels, (size_t)(w * h), file) == (size_t)(w * h);
    if (!ok) {
        fprintf(stderr, "%s: not a grey PFM of %d x %d\n", path, width, height);
        exit(1);
    }
    fclose(file);
    GLuint texture = make_texture(GL_R32F, GL_RED, width, height, texels);
    free(texels);
    return texture;
}

typedef struct renderer {
    int width, height;
    mat4 projection;
    GLuint scene, fog, tone, multiply;    /* programs */
    GLuint light, strength, depth, truth; /* textures */
    GLuint scene_framebuffer, light_framebuffer;
} renderer;

static void make_targets(renderer *r)
{
    const GLenum buffers[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    r->light = make_texture(GL_RGBA16F, GL_RGBA, r->width, r->height, NULL);
    r->strength = make_texture(GL_R8, GL_RED, r->width, r->height, NULL);
    r->depth = make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, r->width, r->height, NULL);
    glGenFramebuffers(1, &r->scene_framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, r->scene_framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, r->light, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, r->strength, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, r->depth, 0);
    glDrawBuffers(2, buffers);
    glGenFramebuffers(1, &r->light_framebuffer); /* for what reads depth, or multiplies alone */
    glBindFramebuffer(GL_FRAMEBUFFER, r->light_framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, r->light, 0);
}

static void draw_opaque(const renderer *r)
{
    mat4 view, clip_from_world;
    glm_lookat((vec3){2.2f, 2.4f, 3.6f}, (vec3){0.0f, 0.4f, 0.0f}, (vec3){0.0f, 1.0f, 0.0f}, view);
    glm_mat4_mul((vec4 *)r->projection, view, clip_from_world);
    glBindFramebuffer(GL_FRAMEBUFFER, r->scene_framebuffer);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    glClearBufferfv(GL_COLOR, 0, (const float[]){0.35f, 0.45f, 0.65f, 1.0f});
    glClearBufferfv(GL_COLOR, 1, (const float[]){1.0f, 1.0f, 1.0f, 1.0f});
    glUseProgram(r->scene);
    glUniformMatrix4fv(glGetUniformLocation(r->scene, "clip_from_world"), 1, GL_FALSE, clip_from_world[0]);
    glUniform1i(glGetUniformLocation(r->scene, "first"), 0);
    glUniform1f(glGetUniformLocation(r->scene, "opacity"), 1.0f);
    glUniform1f(glGetUniformLocation(r->scene, "keep_out"), 0.0f);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 24);
}

/* snippet: glass strength */
/* Where glass is drawn, the strength texture keeps 1 - keep_out of what it held: 0 frees the pixel of occlusion, and
 * with the glass's own opacity for keep_out, what is seen through it keeps its share. */
static void draw_glass(const renderer *r, float opacity, float keep_out)
{
    glBindFramebuffer(GL_FRAMEBUFFER, r->scene_framebuffer);
    glUseProgram(r->scene);
    glUniform1f(glGetUniformLocation(r->scene, "opacity"), opacity);
    glUniform1f(glGetUniformLocation(r->scene, "keep_out"), keep_out);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (int face = 24; face < 36; face += 6) { /* from back to front */
        glUniform1i(glGetUniformLocation(r->scene, "first"), face + 1);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 1);
    }
    glDepthMask(GL_TRUE);
}
/* end */

/* One pass over the whole picture, which reads a texture. */
static void run_pass(GLuint framebuffer, GLuint program, GLuint texture, GLenum source, GLenum destination)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program);
    glBindTexture(GL_TEXTURE_2D, texture);
    glBlendFunc(source, destination);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void apply(const renderer *r, glssao_effect *effect, GLuint framebuffer, const char *strength)
{
    if (r->truth) {
        run_pass(framebuffer, r->multiply, r->truth, GL_ZERO, GL_SRC_COLOR);
        return;
    }
    glssao_apply_options options = glssao_default_apply_options();
    options.framebuffer = framebuffer;
    options.strength_texture = strcmp(strength, "full") == 0 ? 0 : r->strength;
    glssao_apply_with(effect, &options);
}

static void draw_frame(const renderer *r, const place *p, glssao_effect *effect, const glssao_settings *settings,
                       bool with_ao)
{
    const float opacity = 0.5f;
    const float keep_out = strcmp(p->strength, "opacity") == 0 ? opacity : 1.0f;
    draw_opaque(r);
    if (with_ao) {
        glssao_frame frame = {.depth_texture = r->depth};
        memcpy(frame.projection, r->projection, sizeof frame.projection);
        with_ao = glssao_compute(effect, &frame, settings) == GLSSAO_OK;
    }
    if (with_ao && strcmp(p->apply, "opaque") == 0)
        apply(r, effect, r->light_framebuffer, "full"); /* there is no glass yet */
    draw_glass(r, opacity, keep_out);
    if (with_ao && strcmp(p->apply, "glass") == 0)
        apply(r, effect, r->light_framebuffer, p->strength);
    if (p->fog)
        run_pass(r->light_framebuffer, r->fog, r->depth, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    if (with_ao && strcmp(p->apply, "fog") == 0)
        apply(r, effect, r->light_framebuffer, p->strength);
    run_pass(0, r->tone, r->light, GL_ONE, GL_ZERO);
    if (with_ao && strcmp(p->apply, "tone-mapping") == 0)
        apply(r, effect, 0, p->strength);
}

int main(int argc, char **argv)
{
    dropin_options o = dropin_read_options(argc, argv);
    const place p = read_place(argc, argv);
    GLFWwindow *window = dropin_open_window("glssao dropin-order", &o);
    renderer r = {.width = 640, .height = 480};
    GLuint vertex_array;
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glm_perspective(0.8f, (float)r.width / (float)r.height, 0.1f, 50.0f, r.projection);
    r.scene = make_program(scene_texts[0], scene_texts[1]);
    r.fog = make_program(whole_picture, fog_text);
    r.tone = make_program(whole_picture, tone_text);
    r.multiply = make_program(whole_picture, multiply_text);
    r.truth = p.truth ? read_truth(p.truth, r.width, r.height) : 0;
    make_targets(&r);
    glssao_effect *effect = NULL;
    const glssao_config config = {
        .get_proc = glfwGetProcAddress, .log = glssao_log_to_stderr, .width = r.width, .height = r.height};
    if (glssao_create(&config, &effect) != GLSSAO_OK)
        return 1;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 0.8f;
    while (!o.ended && !glfwWindowShouldClose(window)) {
        draw_frame(&r, &p, effect, &settings, o.with_ao);
        dropin_show(window, &o, r.width, r.height);
    }
    glssao_destroy(effect);
    glfwTerminate();
    return o.failed;
}
