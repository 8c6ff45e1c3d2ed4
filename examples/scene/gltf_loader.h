/* SPDX-License-Identifier: MIT
 *
 * State shared by the parts of the glTF loader: the checked document, the scene under construction, and the limits on
 * time and memory.
 */
#pragma once

#include "gltf_document.h"
#include "scene_builder.h"

/* The uv sets that a material reads, by their slot in the scene's vertices; the base colour's is first, then the normal
 * map's. */
typedef struct gltf_uv_slots {
    int sets[SCENE_UV_COUNT];
    int count;
} gltf_uv_slots;

/* The vertices of a primitive after reading and posing, before they are added to the scene. Arrays of `count` elements,
 * NULL if the file has no such attribute. */
typedef struct gltf_vertices {
    const gltf_primitive *source; /* NULL: empty */
    size_t pose;                  /* the node whose weights or skin they follow, SIZE_MAX: none */
    gltf_uv_slots slots;
    uint32_t count;
    double center[3]; /* positions are relative to it: 0, 0, 0 unless they lie far from zero */
    float (*positions)[3];
    float (*normals)[3];
    float (*uvs[SCENE_UV_COUNT])[2];
    float (*colors)[4];
    float (*tangents)[4]; /* NULL too where they are posed or have no use: then they are computed */
    bool mirrored;        /* a skin turns the primitive inside out: the triangles' winding must be swapped */
    bool normals_ok;      /* all finite and of some length */
    bool translucent;     /* a vertex colour's alpha is below 1 */
    bool emitted;         /* they are in the scene from `first` on */
    uint32_t first;
} gltf_vertices;

/* Counts of things that are left out of the scene, for one warning. */
typedef struct gltf_omissions {
    unsigned without_positions, empty, flattened, cameras;
} gltf_omissions;

/* The scene's meshes that the document's becomes: one for each center of its vertices. */
typedef struct gltf_mesh_range {
    int first, count;
} gltf_mesh_range;

typedef struct gltf_decoding gltf_decoding;

typedef struct gltf_loader {
    gltf_document *document;
    scene_builder *builder;
    failure *fault;
    bool flat_normals;                           /* as in scene_load_options */
    double (*world_from_node)[16];               /* of every node */
    bool *drawn;                                 /* of every node */
    int *material_map, *texture_map, *image_map; /* the scene's index for the document's; -1: not made yet */
    int default_material;                        /* the scene's index, -1: not made yet */
    int *opaque_map, *unlit_map;                 /* variations: of each of the scene's materials, index + 1 */
    size_t opaque_room, unlit_room;
    gltf_mesh_range *mesh_map; /* for meshes that are drawn as they are; first -1: not made yet */
    gltf_vertices recent;      /* of the last primitive; the next one often shares them */
    gltf_omissions omitted;
    uint64_t reads_left;
    gltf_decoding *decoding;
} gltf_loader;

/* gltf.c: limits and maps of a loader whose document, builder and fault are set. Ending is due in either case. */
bool gltf_loader_begin(gltf_loader *l);
void gltf_loader_end(gltf_loader *l);

/* gltf_animation.c: the nodes as the first animation has them at a time, in place of the document's. `pose` holds them,
 * and is to be freed after the document's last use, in either case. */
typedef struct gltf_pose {
    gltf_node *nodes;
    double **weights; /* of each node that has animated ones */
    size_t count;
} gltf_pose;

bool gltf_animate(gltf_loader *l, gltf_document *document, double time_s, gltf_pose *pose);
void gltf_free_pose(gltf_pose *pose);

/* gltf_read.c: an accessor's elements with `components` numbers each, in new memory that the caller frees. NULL on
 * failure. */

typedef enum gltf_scaling {
    GLTF_AS_SAID,   /* integers are scaled to 0..1 or -1..1 where the accessor says normalized */
    GLTF_NORMALIZED /* always */
} gltf_scaling;

float *gltf_read_floats(gltf_loader *l, int accessor, int components, gltf_scaling scaling);
uint32_t *gltf_read_indices(gltf_loader *l, int accessor, int components);

/* gltf_material.c: the scene's material for the document's (-1: the default), made with its texture and image when it
 * is first asked for; -1 on failure. */
int gltf_add_material(gltf_loader *l, int material);

/* A variation of one of the scene's materials, made when it is first asked for; -1 on failure. Opaque: itself, unless
 * it blends with an alpha of 1 everywhere, vertex colours aside. */
int gltf_add_unlit(gltf_loader *l, int material);
int gltf_add_opaque(gltf_loader *l, int material);

/* Which uv sets the material reads. */
gltf_uv_slots gltf_find_uv_slots(const gltf_material *m);

/* gltf_image.c: the scene's image for the document's, decoded when it is first asked for; -1 where it is left out, with
 * a warning. False on failure. */
bool gltf_add_image(gltf_loader *l, int image, int *out_image);

/* gltf_vertices.c: reads a primitive's vertices into l->recent, in the pose of the node, unless l->recent holds them
 * already. */
bool gltf_read_vertices(gltf_loader *l, const gltf_primitive *primitive, size_t node, const gltf_uv_slots *slots);
/* Makes `positions` (double precision) relative to their middle where that is far from zero, and stores both. */
void gltf_center_vertices(gltf_vertices *v, double (*positions)[3]);
void gltf_free_vertices(gltf_vertices *v);

/* gltf_skin.c: moves vertices to world space by the joints of the node's skin. */
bool gltf_pose_skin(gltf_loader *l, gltf_vertices *v, int skin, size_t node);

/* gltf_topology.c: the triangles, lines or points of the primitive whose vertices are l->recent, as indices into those.
 * The caller frees them. */
typedef struct gltf_triangles {
    uint32_t *indices; /* three a triangle, counter-clockwise seen from the front; two a line, one a point */
    uint32_t count;    /* of indices */
} gltf_triangles;

bool gltf_make_triangles(gltf_loader *l, const gltf_primitive *p, gltf_triangles *out);
scene_topology gltf_find_topology(const gltf_primitive *p);

/* gltf_mesh.c: the scene's meshes for the one that a node draws. */
bool gltf_add_mesh(gltf_loader *l, size_t node, gltf_mesh_range *out);

/* gltf_tangents.c: gives the vertices of triangles whose indices are the scene's a tangent: the file's, or one
 * computed from uv set `uv`, for which vertices are split (and indices changed) where triangles disagree. */
bool gltf_add_tangents(gltf_loader *l, gltf_triangles *triangles, int uv);

/* gltf_node.c: computes the world matrices of all nodes, then adds instances, cameras and lights of the chosen scene.
 */
bool gltf_place_nodes(gltf_loader *l);
/* The world matrices of a node's EXT_mesh_gpu_instancing instances, for the caller to free; NULL on failure. */
double (*gltf_read_instances(gltf_loader *l, size_t node, size_t *out_count))[16];
/* Calls `visit` for each node that the shown scene names, until it fails; without scenes, for all roots. */
bool gltf_visit_shown(gltf_loader *l, bool (*visit)(gltf_loader *l, size_t node));
bool gltf_add_scene(gltf_loader *l);
/* gltf.c: one warning that names what gltf_add_scene left out. */
bool gltf_warn_of_omissions(gltf_loader *l);
