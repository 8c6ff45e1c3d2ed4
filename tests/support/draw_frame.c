/* SPDX-License-Identifier: MIT */
#include "draw_frame.h"

#include "fixture.h"

const scene_view frame_front = {.view_from_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                .clip_from_view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.5f, 0, 0, 0, 0, 1},
                                .width = FRAME_SIZE,
                                .height = FRAME_SIZE};

typedef struct target {
    int size;
    GLuint normals, depth, color; /* RGBA32F, DEPTH_COMPONENT24, SRGB8_ALPHA8 */
    GLuint normals_framebuffer, color_framebuffer;
} target;

static GLuint make_framebuffer(GLuint color, GLuint depth)
{
    GLuint name;
    assert_true(gl_make_framebuffer(color, depth, &name));
    return name;
}

static target make_target(int size)
{
    target t = {.size = size};
    t.normals = gl_make_texture(GL_RGBA32F, GL_RGBA, GL_FLOAT, size, size, NULL);
    t.depth = gl_make_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT, size, size, NULL);
    t.color = gl_make_texture(GL_SRGB8_ALPHA8, GL_RGBA, GL_FLOAT, size, size, NULL);
    t.normals_framebuffer = make_framebuffer(t.normals, t.depth);
    t.color_framebuffer = make_framebuffer(t.color, t.depth);
    return t;
}

static void free_target(target *t)
{
    const GLuint textures[] = {t->normals, t->depth, t->color};
    const GLuint framebuffers[] = {t->normals_framebuffer, t->color_framebuffer};
    gl.DeleteTextures(3, textures);
    gl.DeleteFramebuffers(2, framebuffers);
}

static frame draw_by(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, bool prepass,
                     unsigned ambient_map)
{
    scene_draw_shadow(r, lighting);
    target t = make_target(view->width);
    const float cleared[4] = {FRAME_EMPTY, FRAME_EMPTY, FRAME_EMPTY, FRAME_EMPTY}, far_depth = 1;
    gl.BindFramebuffer(GL_FRAMEBUFFER, t.normals_framebuffer);
    gl.ClearBufferfv(GL_COLOR, 0, cleared);
    gl.ClearBufferfv(GL_DEPTH, 0, &far_depth);
    if (prepass)
        scene_draw_normals(r, view);
    frame f = {.normals = fixture_read_texture(t.normals, t.size, t.size, 4)};
    gl.BindFramebuffer(GL_FRAMEBUFFER, t.color_framebuffer);
    scene_draw_main(r, view, lighting, ambient_map);
    f.counts = scene_renderer_counts(r);
    f.color = malloc((size_t)(t.size * t.size) * 4);
    gl.ReadPixels(0, 0, t.size, t.size, GL_RGBA, GL_UNSIGNED_BYTE, f.color);
    f.depth = fixture_read_depth(t.depth, t.size, t.size);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    free_target(&t);
    return f;
}

frame frame_draw(const small_scene *s, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map)
{
    return frame_draw_with(s, view, lighting, NULL, ambient_map);
}

frame frame_draw_with(const small_scene *s, const scene_view *view, const scene_lighting *lighting,
                      const scene_draw_options *options, unsigned ambient_map)
{
    char error[512];
    SCOPED(renderer) scene_renderer *r = scene_renderer_create(&s->scene, FAULT(error));
    if (!r)
        fail_msg("%s", error);
    if (options && !scene_renderer_configure(r, lighting, options, FAULT(error)))
        fail_msg("%s", error);
    const frame f = draw_by(r, view, lighting, !options || !options->no_prepass, ambient_map);
    return f;
}

frame frame_draw_by(scene_renderer *r, const scene_view *view, const scene_lighting *lighting, unsigned ambient_map)
{
    return draw_by(r, view, lighting, true, ambient_map);
}

void frame_free(frame *f)
{
    free(f->normals);
    free(f->depth);
    free(f->color);
}

bool frame_is_drawn(const frame *f, int pixel)
{
    return f->normals[4 * pixel] != FRAME_EMPTY;
}

int frame_count_drawn(const frame *f, int pixels)
{
    int count = 0;
    for (int i = 0; i < pixels; i++)
        count += frame_is_drawn(f, i);
    return count;
}

int frame_count_drawn_by(small_scene *s)
{
    const scene_lighting lighting = scene_default_lighting();
    SCOPED(drawn) frame f = frame_draw(s, &frame_front, &lighting, 0);
    const int count = frame_count_drawn(&f, FRAME_SIZE * FRAME_SIZE);
    free(s);
    return count;
}

void frame_add_quad(small_scene *s, scene_material material, const float world_from_mesh[16])
{
    static const float corner[3] = {-0.5f, -0.5f, 0}, along_x[3] = {1, 0, 0}, along_y[3] = {0, 1, 0};
    small_scene_begin_mesh(s, small_scene_add_material(s, material));
    small_scene_add_quad(s, corner, along_x, along_y);
    small_scene_add_instance(s, world_from_mesh);
}

small_scene *frame_one_quad(scene_material material, const float world_from_mesh[16])
{
    small_scene *s = small_scene_create();
    frame_add_quad(s, material, world_from_mesh);
    return s;
}

static int srgb(double linear)
{
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
    return (int)lround(255 * fmin(fmax(encoded, 0), 1));
}

void frame_assert_color(const uint8_t color[4], double r, double g, double b)
{
    const int wanted[3] = {srgb(r), srgb(g), srgb(b)};
    for (int c = 0; c < 3; c++)
        if (abs(color[c] - wanted[c]) > 1)
            fail_msg("colour %d %d %d, not %d %d %d", color[0], color[1], color[2], wanted[0], wanted[1], wanted[2]);
}
