/* SPDX-License-Identifier: MIT
 *
 * The members of a scene_renderer. draw_upload.c, draw_items.c and draw_programs.c fill them; draw.c, draw_main.c and
 * draw_shadow.c read them every frame.
 */
#pragma once

#include "draw.h"
#include "program.h"

/* Vertex attributes; a matrix takes one location a column. */
enum {
    ATTRIBUTE_POSITION = 0,
    ATTRIBUTE_NORMAL = 1,
    ATTRIBUTE_UVS = 2,
    ATTRIBUTE_COLOR = 3,
    ATTRIBUTE_WORLD_FROM_MESH = 4,
    ATTRIBUTE_NORMAL_WORLD_FROM_MESH = 8,
    ATTRIBUTE_TANGENT = 11,
    ATTRIBUTE_MORE_UVS = 12
};

/* As the vertex shader reads it: columns of three. */
typedef struct draw_instance {
    float world_from_mesh[4][3];
    float normal_world_from_mesh[3][3];
} draw_instance;

typedef enum draw_kind {
    DRAW_NORMALS = 0,
    DRAW_MAIN,
    DRAW_SHADOW,
    DRAW_LAYER,
    DRAW_MOTION,
    DRAW_KIND_COUNT,
    DRAW_SKY = DRAW_KIND_COUNT
} draw_kind;

/* One draw call: a primitive for the instances of its mesh that are mirrored, or for those that are not. Blended
 * primitives get an item for each instance, since each has its place in the order of depth. */
typedef struct draw_item {
    uint32_t first_index, index_count;
    uint32_t first_instance, instance_count; /* in the instance buffer */
    int material;
    bool colored, blended, flat;
    scene_topology topology;
    bool mirrored;                       /* triangles change their winding */
    unsigned variant;                    /* of the main pass, without the bits that the options decide */
    int program[DRAW_KIND_COUNT];        /* index into the pool's variants, -1: not drawn so */
    double bounds_min[3], bounds_max[3]; /* world space, of all instances */
} draw_item;

typedef struct draw_order {
    double view_distance;
    uint32_t item;
} draw_order;

typedef struct draw_variant {
    draw_kind kind;
    unsigned variant;
    draw_program program;
} draw_variant;

/* Programs, which renderers of one context share. */
typedef struct draw_pool {
    int users;
    draw_variant *variants; /* built as items need them */
    int variant_count;
    draw_program map, view_distance, surfaces; /* the same */
} draw_pool;

struct scene_environment {
    unsigned sky, mirrors, sampler; /* the mirrors' mip levels are their roughness */
    float irradiance[9][3];         /* as in environment.h */
};

typedef struct draw_shadow {
    bool used;
    bool drawn; /* for this direction: */
    float direction_world[3];
    int size;
    unsigned texture, framebuffer, sampler;
    float view_from_world[16], clip_from_view[16], shadow_from_world[16]; /* the last: uv and depth, 0..1 */
} draw_shadow;

/* How much of the sky the last drawing of a view showed. */
typedef struct draw_sky_seen {
    unsigned query; /* 0: not made */
    bool asked;     /* of this view: */
    scene_view view;
} draw_sky_seen;

enum { DRAW_VERTEX_PARTS = 4 }; /* positions, normals, uv sets, colours */

struct scene_renderer {
    const scene *scene;
    unsigned vertex_array, empty_vertex_array;
    unsigned vertex_buffers[DRAW_VERTEX_PARTS]; /* 0: no draw call reads it */
    unsigned tangent_buffer, more_uv_buffer, index_buffer, instance_buffer;
    unsigned last_positions, last_instance_buffer; /* of the pose before; 0: there was none */
    unsigned motion_vertex_array;                  /* 0: not made */
    unsigned *images[2]; /* GL texture of each of the scene's images, 0 where no material uses it: linear, sRGB */
    unsigned *samplers;  /* of each of the scene's textures, 0 likewise */
    unsigned linear_sampler, nearest_sampler; /* clamped, for screen-sized maps */
    unsigned white_texture;                   /* stands in for the ambient map */
    unsigned neutral[2]; /* for options.everything: white, and the unbent normal, where the material has no map */
    draw_item *items;    /* opaque triangles first, sorted by program and material; then opaque lines and points; then
                            blended ones as in the file */
    uint32_t opaque_count, first_blended, item_count;
    draw_order *blended_order; /* scratch, one for each blended item */
    draw_pool *pool;
    scene_draw_options options;
    bool configured;
    draw_shadow shadow;
    draw_sky_seen sky_seen;
    scene_draw_counts counts;
};

/* The inverse transpose of the upper 3x3 of a column-major affine matrix, up to a positive factor: scaled so that its
 * largest element is 1. Where the matrix is singular it is the limit from the unmirrored side. Returns true for a
 * matrix that mirrors. */
bool draw_normal_matrix(const float affine[16], float out[3][3]);

/* Values that all draw calls of a pass share, and the state that the last one left bound. */
typedef struct draw_pass {
    const scene_renderer *renderer;
    const scene_view *view;
    draw_kind kind;
    float normal_view_from_world[3][3];
    double clip_from_world[16];
    float depth_offset;                                                              /* layers */
    const scene_view *last;                                                          /* motion */
    float ambient[3], ambient_tilt[3], up_view[3], directional[3], to_light_view[3]; /* main pass */
    float lights[MOST_LIGHTS][4][4];
    int light_count;
    const scene_environment *environment;
    float sky_from_view[3][3];

    const draw_program *program;
    unsigned variant;
    int material;
    bool mirrored;
    uint32_t first_instance;
} draw_pass;

/* draw_upload.c: creates r->neutral on first use; fills the vertex buffers; points the bound vertex array
 * to what it holds; uploads into a buffer, made where its name is 0. */
void draw_make_neutral(scene_renderer *r);
void draw_upload_vertices(scene_renderer *r);
void draw_point_vertices(const scene_renderer *r);
void draw_upload_buffer(unsigned *name, unsigned target, const void *data, size_t size);

/* draw_items.c: decides which draw calls the scene takes; fills instances[s->instance_count]. */
bool draw_plan_items(scene_renderer *r, draw_instance *instances);
/* False if the item lies outside the view volume of the matrix. */
bool draw_item_is_seen(const draw_item *item, const double clip_from_world[16]);

/* draw_programs.c: false where the sky is one colour. */
bool draw_has_sky(const scene_lighting *lighting);
/* Index of its program among the pool's variants, built on first use; -1, with one line in `error`, on failure. */
int draw_find_sky(scene_renderer *r, const scene_lighting *lighting, failure *fault);

/* draw_shadow.c */
bool draw_shadow_wanted(const scene_renderer *r, const scene_lighting *lighting, const scene_draw_options *options);
bool draw_shadow_make(scene_renderer *r, int size, failure *fault);
void draw_shadow_free(draw_shadow *s);
/* The polygon offset of its drawing. */
void draw_shadow_offset(void);

/* draw_pool.c: joins the pool of `like`, or makes one if that is NULL; leaves the pool, and frees it with its last
 * user. */
bool draw_pool_join(scene_renderer *r, const scene_renderer *like, failure *fault);
void draw_pool_leave(scene_renderer *r);

/* draw.c: GL's defaults; one texture; all items of a kind, with the view's matrices. */
void draw_set_defaults(void);
void draw_bind_texture(unsigned unit, unsigned texture, unsigned sampler);
draw_pass draw_begin(const scene_renderer *r, const scene_view *view, draw_kind kind);
void draw_item_now(draw_pass *pass, const draw_item *item);
/* Draws the visible opaque items. Returns their number and adds the number of the others to *out_culled. */
unsigned draw_opaque(draw_pass *pass, unsigned *out_culled);
/* Configures a renderer with the plainest options if the host did not; false if that fails, with a line on stderr. */
bool draw_is_ready(scene_renderer *r);
/* A whole pass: draws the visible opaque items as `kind`. Returns their number and adds the number of the others to
 * *out_culled. */
unsigned draw_opaque_items(scene_renderer *r, const scene_view *view, draw_kind kind, unsigned *out_culled);
