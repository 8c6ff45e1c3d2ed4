/* SPDX-License-Identifier: MIT
 *
 * A scene in memory, as the examples draw it: triangles, materials, textures, instances, cameras. It comes from a
 * glTF 2.0 file or from one of the built-in scenes, and knows nothing of OpenGL. World space is glTF's: right-handed,
 * y up, lengths in scene units; its zero is moved to the scene's middle where that is far away (scene.origin).
 * Matrices are column-major (cglm's mat4 as float[16]).
 */
#pragma once

#include "fault.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_vertex {
    float position[3]; /* mesh space */
    float normal[3];   /* mesh space, unit length; not to be used where the primitive is flat */
    float uv[2][2];    /* of the first two uv sets that the material reads, as in the file: v grows downwards */
    float color[4];    /* linear; 1, 1, 1, 1 without vertex colours */
} scene_vertex;

/* Rows top to bottom, as in the file. */
typedef struct scene_image {
    int width, height;
    uint8_t *rgba; /* NULL: opaque, and freed after the upload */
    bool opaque;   /* every alpha is 255 */
} scene_image;

enum { SCENE_UV_COUNT = 4 };

typedef enum scene_wrap { SCENE_WRAP_REPEAT = 0, SCENE_WRAP_MIRROR, SCENE_WRAP_CLAMP } scene_wrap;

typedef struct scene_texture {
    int image; /* index, always valid */
    scene_wrap wrap_u, wrap_v;
    bool min_nearest, mag_nearest, mipmaps;
} scene_texture;

/* How a material reads a texture other than its base colour. */
typedef struct scene_map {
    bool used;
    int texture;         /* index into textures; linear, but for emission, which is sRGB */
    int uv;              /* which of the vertex's uv sets, below SCENE_UV_COUNT: 2 and 3 lie in more_uvs */
    float uv_from_uv[6]; /* as base_color_uv_from_uv */
} scene_map;

typedef enum scene_alpha { SCENE_ALPHA_OPAQUE = 0, SCENE_ALPHA_MASK, SCENE_ALPHA_BLEND } scene_alpha;

typedef struct scene_material {
    float base_color[4];            /* linear factor */
    int base_color_texture;         /* index into textures, -1: none; sRGB */
    int base_color_uv;              /* which of the vertex's uv sets, 0 or 1 */
    float base_color_uv_from_uv[6]; /* KHR_texture_transform: u' = m0 u + m1 v + m2, v' = m3 u + m4 v + m5 */
    scene_alpha alpha;
    float alpha_cutoff; /* MASK: drawn where alpha >= cutoff */
    bool double_sided;
    bool unlit;                       /* KHR_materials_unlit */
    bool metallic_roughness;          /* reflects as glTF's model says; false: matte, by Lambert's law alone */
    float metallic, roughness;        /* factors, 0..1 */
    scene_map metallic_roughness_map; /* roughness in green, metallic in blue */
    scene_map normal_map;             /* tangent space, stored as 0..1 */
    float normal_scale;               /* of its x and y */
    scene_map occlusion_map;          /* baked accessibility of ambient light, in red */
    float occlusion_strength;         /* 0..1 */
    scene_map emissive_map;
    float emissive[3]; /* linear radiance, factor of the map */
} scene_material;

typedef enum scene_topology { SCENE_TRIANGLES = 0, SCENE_LINES, SCENE_POINTS } scene_topology;

/* Triangles, lines or points that share a material: indices[first_index .. first_index + index_count), absolute into
 * vertices; 3, 2 or 1 each. Lines and points are a pixel wide, unlit, cast nothing and receive no occlusion. */
typedef struct scene_primitive {
    uint32_t first_index, index_count;
    int material;
    scene_topology topology;
    bool white; /* no vertex has another colour; false: not known */
    bool flat;  /* the file has no normals: each triangle's own is its normal, and the vertices' are not to be used */
    float bounds_min[3], bounds_max[3]; /* mesh space */
} scene_primitive;

typedef struct scene_mesh {
    uint32_t first_primitive, primitive_count;
    uint32_t first_instance, instance_count; /* instances are sorted by mesh */
} scene_mesh;

typedef struct scene_instance {
    float world_from_mesh[16]; /* affine; may mirror, or flatten to a plane, but not to a line or a point */
} scene_instance;

typedef struct scene_camera {
    char name[64];
    float world_from_view[16];
    bool orthographic;
    float fov_y_rad;               /* perspective */
    float half_width, half_height; /* orthographic, scene units */
    float near_plane, far_plane;   /* far 0: infinite */
} scene_camera;

typedef enum scene_light_kind { SCENE_LIGHT_DIRECTIONAL = 0, SCENE_LIGHT_POINT, SCENE_LIGHT_SPOT } scene_light_kind;

typedef struct scene_light { /* KHR_lights_punctual */
    scene_light_kind kind;
    float color[3]; /* linear, times intensity: irradiance (directional), or candela */
    float position_world[3];
    float direction_world[3];   /* unit, the way the light travels */
    float range;                /* scene units; 0: infinite */
    float inner_cos, outer_cos; /* spot: of the angles from its axis, inner_cos > outer_cos */
} scene_light;

typedef struct scene {
    char name[256]; /* file name, or the built-in scene's */
    scene_vertex *vertices;
    uint32_t vertex_count;
    float (*tangents)[4];    /* of each vertex: unit, mesh space, and the bitangent's sign; zeros where no normal
                                map is. NULL where no material drawn has one */
    float (*more_uvs)[2][2]; /* of each vertex: uv sets 2 and 3. NULL where no material reads them */
    uint32_t *indices;
    uint32_t index_count;
    scene_primitive *primitives;
    uint32_t primitive_count;
    scene_mesh *meshes;
    uint32_t mesh_count;
    scene_instance *instances;
    uint32_t instance_count;
    scene_material *materials;
    uint32_t material_count; /* at least 1 */
    scene_texture *textures;
    uint32_t texture_count;
    scene_image *images;
    uint32_t image_count;
    scene_camera *cameras;
    uint32_t camera_count;
    scene_light *lights;
    uint32_t light_count;
    /* Place of world space's zero in the file's coordinates. It is 0, 0, 0 unless the scene's middle is so far from the
     * file's zero that single precision would coarsen the scene. */
    double origin[3];
    char **warnings;
    size_t warning_count;               /* one line each, without the file's name */
    float bounds_min[3], bounds_max[3]; /* world space, of everything drawn; all 0 in an empty scene */
} scene;

typedef struct scene_load_options { /* all zero: the file as it stands */
    bool timed;
    double time_s; /* if timed: pose the nodes as the animation has them at this time; it stops at its first and last
                      key */
    int scene, animation;  /* which of the file's, counted from 1; 0: its default scene, its first animation */
    const char *variant;   /* KHR_materials_variants: its name, or its number from 1 on; NULL: none */
    bool strict;           /* fail where there would be a warning */
    bool flat_normals;     /* ignore the file's normals: every triangle has its own */
    const char *root;      /* files that the glTF file names may also lie below this folder; NULL: only below its own */
    uint64_t memory_bytes; /* limit on what loading the file may allocate; 0: half of the machine's memory */
} scene_load_options;

/* Loads a .gltf or .glb file, or standard input if the path is "-". `options` may be NULL. NULL on failure, with one
 * line in `error` that names the file and the fault. Nothing in the file is trusted: every index, offset, count and
 * reference is checked before use, memory is limited, and files that it names must lie in its own folder or below. The
 * scene's warnings name everything that is drawn in another way than the file says, or not at all. */
scene *scene_load_with(const char *path, const scene_load_options *options, failure *fault);
scene *scene_load(const char *path, failure *fault);

/* Makes a built-in scene: "columns", "cornell", "steps" or "plane". NULL on failure, as above. */
scene *scene_make(const char *name, failure *fault);

/* Triangles of all instances. */
uint64_t scene_count_triangles(const scene *s);

/* Frees the scene; NULL is fine. */
void scene_destroy(scene *s);

#ifdef __cplusplus
}
#endif
