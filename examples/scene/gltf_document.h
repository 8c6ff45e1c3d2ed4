/* SPDX-License-Identifier: MIT
 *
 * A glTF 2.0 file in plain C, without the parts that the examples do not draw. Compressed geometry is unpacked: its
 * accessors name buffer views that lie behind those of the file. gltf_document_open() checks types only; after
 * gltf_check() every index, range and count in the document holds, so that the rest of the loader may follow them
 * freely. Indices are -1 where the file names none.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "fault.h"
#include "memory_budget.h"
#include "scene.h"
#include "scene_warnings.h"

#ifdef __cplusplus
extern "C" {
#endif

/* glTF's component types and primitive modes, which are OpenGL's constants. */
enum {
    GLTF_BYTE = 5120,
    GLTF_UNSIGNED_BYTE = 5121,
    GLTF_SHORT = 5122,
    GLTF_UNSIGNED_SHORT = 5123,
    GLTF_UNSIGNED_INT = 5125,
    GLTF_FLOAT = 5126
};
enum {
    GLTF_POINTS,
    GLTF_LINES,
    GLTF_LINE_LOOP,
    GLTF_LINE_STRIP,
    GLTF_TRIANGLES,
    GLTF_TRIANGLE_STRIP,
    GLTF_TRIANGLE_FAN
};

typedef struct gltf_buffer {
    const uint8_t *data;
    size_t size;
} gltf_buffer;

typedef struct gltf_buffer_view {
    int buffer;
    size_t offset, length, stride; /* bytes; stride 0: tightly packed */
} gltf_buffer_view;

typedef struct gltf_sparse {
    int64_t count; /* 0: not sparse */
    int index_view, index_type, value_view;
    int64_t index_offset, value_offset;
} gltf_sparse;

typedef struct gltf_accessor {
    int buffer_view; /* -1: zeros */
    size_t offset, count;
    int component_type;
    int rows, columns; /* VEC3: 3, 1; MAT4: 4, 4 */
    bool normalized;
    gltf_sparse sparse;
} gltf_accessor;

typedef struct gltf_attribute {
    const char *name;
    int accessor;
} gltf_attribute;

typedef struct gltf_attribute_list {
    const gltf_attribute *items;
    size_t count;
} gltf_attribute_list;

typedef struct gltf_primitive {
    gltf_attribute_list attributes;
    const gltf_attribute_list *targets;
    size_t target_count;
    int indices, material, mode;
} gltf_primitive;

typedef struct gltf_weights {
    const double *values;
    size_t count;
} gltf_weights;

typedef struct gltf_mesh {
    const gltf_primitive *primitives;
    size_t primitive_count;
    gltf_weights weights;
} gltf_mesh;

typedef struct gltf_node {
    int mesh, skin, camera, light;
    bool hidden; /* by KHR_node_visibility, which hides the node's descendants too */
    const int *children;
    size_t child_count;
    bool has_matrix;
    double matrix[16]; /* column-major */
    double translation[3], rotation[4], scale[3];
    gltf_weights weights;
    bool instanced; /* EXT_mesh_gpu_instancing; accessors: */
    int instance_translation, instance_rotation, instance_scale;
} gltf_node;

typedef struct gltf_skin {
    const int *joints;
    size_t joint_count;
    int inverse_bind_matrices;
} gltf_skin;

typedef struct gltf_texture_use {
    int texture, uv_set;
    double offset[2], scale[2], rotation; /* KHR_texture_transform; radians */
} gltf_texture_use;

typedef struct gltf_material {
    double base_color[4], metallic, roughness, normal_scale, occlusion_strength;
    double emissive[3];  /* KHR_materials_emissive_strength multiplied in */
    double transmission; /* KHR_materials_transmission */
    gltf_texture_use base_color_map, metallic_roughness_map, normal_map, occlusion_map, emissive_map;
    const char *alpha_mode;
    double alpha_cutoff;
    bool double_sided, unlit;
} gltf_material;

typedef struct gltf_texture {
    int sampler, image;
} gltf_texture;

typedef struct gltf_sampler {
    int min_filter, mag_filter, wrap_s, wrap_t; /* OpenGL's numbers; -1: not given */
} gltf_sampler;

typedef struct gltf_image {
    const char *name; /* its URI or name; "" where it has neither */
    int buffer_view;
    const uint8_t *encoded; /* NULL: in the buffer view, or not found */
    size_t encoded_size;
    const char *fault; /* why it was not found */
} gltf_image;

typedef struct gltf_camera {
    const char *name;
    bool orthographic;
    double fov_y_rad, x_mag, y_mag, near_plane, far_plane;
} gltf_camera;

typedef struct gltf_light { /* KHR_lights_punctual */
    const char *type;
    double color[3], intensity, range, inner_cone_rad, outer_cone_rad; /* range 0: infinite */
} gltf_light;

typedef struct gltf_animation_sampler {
    int input, output; /* accessors */
    const char *interpolation;
} gltf_animation_sampler;

typedef struct gltf_animation_channel {
    int sampler, node; /* node -1: an extension's target */
    const char *path;
} gltf_animation_channel;

typedef struct gltf_scene {
    const int *nodes;
    size_t node_count;
} gltf_scene;

/* Each list as pointer and length; the pointers lead into `owner`. */
typedef struct gltf_document {
    void *owner;
    size_t source_bytes;  /* of the file, of the external files that it names, and of what was unpacked */
    memory_budget budget; /* what the file may still make the loader allocate */
    scene_warnings *warnings;
    const char *version, *min_version;
    double center[3]; /* CESIUM_RTC: added to the place of every node */
    int default_scene;
    const gltf_buffer *buffers;
    const gltf_buffer_view *buffer_views;
    const gltf_accessor *accessors;
    const gltf_mesh *meshes;
    const gltf_node *nodes;
    const gltf_skin *skins;
    const gltf_material *materials;
    const gltf_texture *textures;
    const gltf_sampler *samplers;
    const gltf_image *images;
    const gltf_camera *cameras;
    const gltf_light *lights;
    const gltf_scene *scenes;
    size_t animation_count;
    int animation; /* the chosen one, whose samplers and channels follow */
    const gltf_animation_sampler *animation_samplers;
    const gltf_animation_channel *animation_channels;
    size_t animation_sampler_count, animation_channel_count;
    size_t buffer_count, buffer_view_count, accessor_count, mesh_count, node_count, skin_count, material_count,
        texture_count, sampler_count, image_count, camera_count, light_count, scene_count;
} gltf_document;

/* Reads and parses the file, as the options say (NULL: the file as it stands). `warnings` must outlive the document. On
 * failure false, with the fault set, and nothing to close. */
bool gltf_document_open(gltf_document *out, const char *path, const scene_load_options *options,
                        scene_warnings *warnings, failure *fault);
void gltf_document_close(gltf_document *document);

/* True where every reference, range and count in the document holds, animations aside; otherwise the fault says which
 * does not. Factors may still be out of range by a rounding error. */
bool gltf_check(const gltf_document *document, failure *fault);

/* The accessor of the attribute of that name, -1 if the list has none. */
int gltf_find_attribute(const gltf_attribute_list *list, const char *name);

/* Bytes of one component, 0 for a type that glTF does not have; of one element, columns aligned as glTF asks. */
size_t gltf_component_size(int component_type);
size_t gltf_element_size(const gltf_accessor *accessor);

#ifdef __cplusplus
}
#endif
