/* SPDX-License-Identifier: MIT
 *
 * What an effect is made of, and the internal functions of the library, by file.
 */
#ifndef GLSSAO_EFFECT_H
#define GLSSAO_EFFECT_H

#include "glssao/glssao.h"
#include "opengl.h"

#include <stdarg.h>

#if defined(__GNUC__)
#define GLSSAO_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define GLSSAO_PRINTF(text, first)
#endif

/* Texture units that the passes read through; the shaders' samplers are tied to them once. */
enum glssao__unit {
    UNIT_NORMAL = 0,
    UNIT_DEPTH,
    UNIT_RANDOM_VECTOR,
    UNIT_AMBIENT,
    UNIT_DISTANCE,
    UNIT_BACK,
    UNIT_SECOND,
    UNIT_TILES,
    UNIT_COUNT
};

/* The D3D12 demo's static samplers. */
enum glssao__sampler {
    SAMPLER_POINT_CLAMP = 0,
    SAMPLER_LINEAR_CLAMP,
    SAMPLER_DEPTH,
    SAMPLER_LINEAR_WRAP,
    SAMPLER_COUNT
};

enum glssao__block {
    BLOCK_SSAO = 0,
    BLOCK_FRAME,
    BLOCK_HEMISPHERE,
    BLOCK_COUNT
}; /* also the uniform buffer binding points used */

/* What is drawn; with the flags below it names one program. program.c holds the tables of both. */
enum glssao__shader {
    SHADER_INPUT = 0,
    SHADER_NORMALS,
    SHADER_DISTANCE,
    SHADER_CLASSIC,
    SHADER_HEMISPHERE,
    SHADER_HORIZON,
    SHADER_RESOLVE,
    SHADER_PROBE,
    SHADER_BLUR,
    SHADER_PLANAR_BLUR,
    SHADER_UPSAMPLE,
    SHADER_SPREAD,
    SHADER_PLANAR_TILE, /* both in one, by compute shader alone */
    SHADER_APPLY,
    SHADER_TILE_ROWS,
    SHADER_TILE_BOUNDS,
    SHADER_TILE_CLASS,
    SHADER_TILE_RINGS,
    SHADER_COUNT
};

/* Variants: each flag is a macro that is 0 or 1 in the shaders that test it. */
enum glssao__variant {
    VARIANT_UNSIGNED_NORMALS = 1,
    VARIANT_OCTAHEDRAL_NORMALS = 2,
    VARIANT_DEPTH_IS_DISTANCE = 4,
    VARIANT_DEPTH_IN_ALPHA = 8, /* of the normal map, as view distance; comes with DEPTH_IS_DISTANCE */
    VARIANT_NO_ANGLE_WEIGHT = 16,
    VARIANT_BOX = 32,
    VARIANT_EDGE_AWARE = 64,
    VARIANT_STEPS_8 = 128,
    VARIANT_STEPS_12 = 256,
    VARIANT_STEPS_16 = 512,
    VARIANT_SLICES_2 = 1024,
    VARIANT_ACCUMULATE = 2048,
    VARIANT_LAYERS = 4096,
    VARIANT_PAIRED = 8192,
    VARIANT_MULTISAMPLE = 16384,
    VARIANT_LOGARITHMIC = 32768,
    VARIANT_OPEN = 65536,
    VARIANT_PLANES = 131072,
    VARIANT_FROM_DEPTH = 262144,
    VARIANT_COMPUTE = 524288,
    VARIANT_UPSAMPLE = 1048576,
    VARIANT_ROUNDS_1 = 2097152,
    VARIANT_ROUNDS_2 = 4194304,
    VARIANT_WIDE = 8388608,
    VARIANT_PERSPECTIVE = 16777216,
    VARIANT_BRANCHES = 33554432,
    VARIANT_FLAGS = 26 /* how many there are */
};

enum {
    RANDOM_VECTOR_MAP_SIZE = 256,
    HEMISPHERE_CAPACITY = 64,
    ROTATION_TILE = 4,
    PROBE_SIZE = 128,
    TRANSFER_PARAMETERS = 12,
    TILE_ESTIMATES = 16,
    TILE_PASSES = 4,
    TIMER_FRAMES = 4,
    COMPUTE_ROUNDS = 2, /* of the planar blur that one dispatch runs, at most */
    MAX_DRAW_BUFFERS = 8,
    INPUT_COUNT = 4,
    TOGGLE_CAPACITY = 32
};

typedef struct glssao__log_sink {
    glssao_log_fn write; /* may be NULL */
    void *user;
} glssao__log_sink;

/* Border of maps that hold view distance, as the D3D11 demo has it: beyond it nothing occludes. */
#define SKY_DISTANCE 1e5f
#define FAR_AWAY 1e15f /* as in glsl/view.glsl */

/* glsl/cb_frame.glsl in C. */
typedef struct glssao__frame_constants {
    float gDistanceFromDepth[4];
    float gRayOrigin[4];
    float gRayDirection[4];
    float gSkyDepth;
    float gPower;
    float gBlurNormalThreshold;
    float gBlurDepthThreshold;
    int gSampleCount;
    int gFactor;
    float gNoise[2];
    float gAccumulation[4];
    float gProbe[4];
    float gDepthStep[4];
    float gLogDepth[4];
    float gTiles[4];
    float gPixel[4];
    float gEstimateSize[2];
    float gFullTexel[2];
    float gTileRings;
    float gPerRadius;
    float gPadding[2]; /* std140 rounds the block up */
} glssao__frame_constants;

/* glsl/cb_hemisphere.glsl in C. */
typedef struct glssao__hemisphere_constants {
    float gKernel[HEMISPHERE_CAPACITY][4];
    float gRotations[ROTATION_TILE * ROTATION_TILE][4];
} glssao__hemisphere_constants;

/* How far apart two values of a depth map may lie that its format tells apart: `step`, or that times the value. */
typedef struct glssao__precision {
    double step;
    bool relative;
} glssao__precision;

/* What a projection says about depth, worked out in double precision. */
typedef struct glssao__projection {
    float view_from_clip[16];
    float distance_from_depth[4], ray_origin[4], ray_direction[4]; /* as in cbFrame */
    float sky_depth;
    float sky_distance; /* scene units; infinite where the far plane is */
    double ends[4];     /* distance_from_depth, unrounded */
} glssao__projection;

typedef struct glssao__ambient_maps {
    gl_uint texture[2], framebuffer[2];
    int width, height;
    gl_enum format;
} glssao__ambient_maps;

/* A texture and the framebuffer that draws into it; 0 where it is not made. */
typedef struct glssao__target {
    gl_uint texture, framebuffer;
    int width, height;
    gl_enum format;
} glssao__target;

/* What tells the tiles that need an estimate; made when first needed. */
typedef struct glssao__tiles {
    glssao__target rows, bounds; /* RGBA32F, as glsl/tile_rows.frag has it */
    glssao__target needed;       /* R32F, 1: needs an estimate */
    glssao__target rings;        /* R32F, as glsl/tile_rings.frag has it */
    bool used;                   /* by the last frame */
    int point;                   /* side of a tile in the target that is drawn to next, pixels; 0: all of it is drawn */
} glssao__tiles;

/* A rectangle of a map, in its pixels. */
typedef struct glssao__region {
    int x, y, width, height;
} glssao__region;

typedef struct glssao__program_object {
    gl_uint name;
    gl_int horizontal_location, origin_location; /* of gHorizontalBlur and gOrigin, -1 where there is none */
    gl_int tile_range_location, region_location; /* of gTileRange and gRegion */
    bool compute;
    int group[2]; /* pixels of the target that a work group makes */
} glssao__program_object;

typedef struct glssao__tile_programs {
    glssao__program_object rows, bounds, needed, rings;
} glssao__tile_programs;

typedef struct glssao__timer_frame {
    gl_uint queries[GLSSAO_PASS_COUNT][2]; /* timestamps before and after */
    bool used[GLSSAO_PASS_COUNT];
} glssao__timer_frame;

/* Estimates of a still view, added up in two replicates, whose difference tells the error of the mean. */
typedef struct glssao__accumulation {
    glssao_frame frame; /* what they were estimated from */
    glssao_settings settings;
    int count[2];          /* estimates in each replicate */
    glssao__target sum;    /* RG32F, full size; made when first needed, as are these: */
    glssao__target probe;  /* RG32F, PROBE_SIZE squared */
    gl_uint probe_buffer;  /* the probe's pixels, on their way to the CPU */
    gl_sync probe_fence;   /* NULL: nothing on its way */
    double sampling_error; /* of the whole mean; negative: not known yet */
} glssao__accumulation;

/* The host's GL state, as state.c found it. */
typedef struct glssao__host_state {
    gl_int program, vertex_array, draw_framebuffer, read_framebuffer, active_texture;
    gl_float viewport[4];
    gl_int textures[UNIT_COUNT], samplers[UNIT_COUNT];
    gl_int image[6]; /* of image unit 0: name, level, layered, layer, access, format */
    gl_int uniform_buffer;
    struct {
        gl_int buffer;
        int64_t offset, size;
    } uniform_binding[BLOCK_COUNT];
    gl_int unpack_buffer, pack_buffer;
    gl_int transfer[TRANSFER_PARAMETERS];
    gl_int polygon_mode[2];
    gl_int clip_origin, clip_depth;
    gl_boolean depth_mask;
    gl_boolean color_mask[MAX_DRAW_BUFFERS][4];
    gl_int blend_function[4], blend_equation[2];
    gl_boolean blend, scissor;
    gl_int scissor_box[4];
    gl_boolean toggles[TOGGLE_CAPACITY];
} glssao__host_state;

struct glssao_effect {
    glssao__gl gl;
    glssao__log_sink log;
    uint32_t seed;
    bool has_timers;
    glssao_path path;     /* as the config has it */
    bool compute_refused; /* the driver did not take a compute shader */
    char *cache_folder;   /* of linked programs; NULL: not kept */
    int width, height;

    glssao__target inputs[INPUT_COUNT]; /* copies of the host's textures; made when first needed */
    glssao__target normal_map;
    glssao__target distance_map; /* at the estimate's size; made when first needed */
    glssao__target result_map;   /* the result, where it has another size than the estimate; made when first needed */
    glssao__target block_map;    /* RGBA16, as glsl/upsample.frag writes it; made when first needed */
    bool has_result_map;         /* the last result lies there */
    int margin;                  /* of the last frame */
    glssao__ambient_maps ambient;
    glssao__ambient_maps paired; /* RG32F, see paired.glsl; made when first needed */
    bool is_dispatched;          /* what compute shaders wrote waits for a barrier */
    bool is_paired;              /* the last frame's passes drew into them */
    glssao__tiles tiles;
    bool ambient_is_one; /* both ambient maps hold 1 everywhere: nothing to clear */
    gl_uint random_vector_map;
    gl_uint depth_texture; /* the host's, as last handed over */
    gl_uint samplers[SAMPLER_COUNT];
    gl_uint vertex_array;
    gl_uint uniform_buffers[BLOCK_COUNT];
    struct glssao__compiled {
        enum glssao__shader shader;
        unsigned variant;
        glssao__program_object object;
    } * programs;                   /* those compiled so far */
    glssao__program_object program; /* in use */
    int program_count;

    glssao_constants constants;
    glssao__frame_constants frame_constants;
    glssao__hemisphere_constants hemisphere_constants;

    glssao__accumulation accumulation;

    bool between_normals; /* glssao_begin_normals was called, glssao_end_normals not yet */
    gl_int host_framebuffer;
    gl_float host_viewport[4];

    uint64_t frame;
    int draw_calls[GLSSAO_PASS_COUNT];
    glssao__timer_frame timers[TIMER_FRAMES];
};

/* log.c: one line to the host's log. */
void glssao__log_write(const glssao__log_sink *log, glssao_log_level level, const char *format, ...)
    GLSSAO_PRINTF(3, 4);

/* projection.c: false, with the reason logged, where the matrix is none that a depth map can come from. */
bool glssao__projection_analyse(const float projection[16], bool clip_zero_to_one, const glssao__log_sink *log,
                                glssao__projection *out);

/* Of logarithmic depth; 0 stands for 1. */
double glssao__projection_log_constant(const glssao_frame *frame);
/* Coefficients of 1, t, t^2 in what the format's step comes to in view distance at the view distance t. */
void glssao__projection_depth_step(const glssao_frame *frame, const glssao__projection *projection,
                                   const glssao__precision *precision, float out_step[4]);

/* constants.c */
void glssao__constants_init(glssao_constants *c, uint32_t seed);
void glssao__constants_init_hemisphere(glssao__hemisphere_constants *c, uint32_t seed);
void glssao__constants_fill_kernel(glssao__hemisphere_constants *c, uint32_t seed, int sample_count);
void glssao__constants_fill(glssao_constants *c, const glssao_frame *frame, const glssao_settings *settings,
                            const glssao__projection *projection, int ambient_width, int ambient_height);
void glssao__constants_fill_frame(glssao__frame_constants *c, const glssao_frame *frame,
                                  const glssao_settings *settings, const glssao__projection *projection,
                                  const glssao__precision *precision, const int full_size[2],
                                  const int estimate_size[2]);
void glssao__constants_gauss_weights(float sigma, float out_weights[3][4]);

/* random.c: PCG32 (O'Neill 2014); the same seed gives the same numbers on every machine. */
typedef struct glssao__random {
    uint64_t state;
} glssao__random;
glssao__random glssao__random_seed(uint32_t seed, uint32_t stream);
uint32_t glssao__random_next(glssao__random *r);
float glssao__random_unit(glssao__random *r);                        /* 0 <= x < 1, 24 bits */
void glssao__random_vector_texels(uint32_t seed, uint8_t *out_rgba); /* RANDOM_VECTOR_MAP_SIZE squared */

/* settings.c: false, with field and value logged, where one is out of range. */
bool glssao__settings_check(const glssao_settings *settings, const glssao__log_sink *log);
bool glssao__settings_check_frame(const glssao_effect *effect, const glssao_frame *frame,
                                  const glssao_settings *settings, const glssao__log_sink *log,
                                  glssao__projection *out_projection);

/* plan.c */
/* What glssao_accumulate runs; `settings` as glssao__accumulate_settings gives them. */
glssao_plan glssao__plan_accumulate(const glssao_effect *effect, const glssao_frame *frame,
                                    const glssao_settings *settings, int estimates);
/* The size of the ambient maps that the settings ask for. */
void glssao__plan_ambient_size(const glssao_effect *effect, const glssao_settings *settings, int *out_width,
                               int *out_height);
/* What is left of a map without so many pixels along each side. */
glssao__region glssao__plan_inner(int width, int height, int margin);
/* What of its map a pass must draw so that the result comes out: all but the margin, and what later passes reach there.
 */
glssao__region glssao__plan_region(const glssao_effect *effect, const glssao_frame *frame,
                                   const glssao_settings *settings, const glssao_plan *plan, glssao_pass pass);
/* What of the last pass's map is the result. */
glssao__region glssao__plan_result(const glssao_effect *effect, const glssao_frame *frame,
                                   const glssao_settings *settings, const glssao_plan *plan);

/* How many texels of the estimate beyond a pixel the passes after it read. */
int glssao__plan_reach(const glssao_settings *settings, const glssao_plan *plan);
/* Whether a pass reads the linear quantity of distance beside accessibility. */
bool glssao__plan_is_paired(const glssao_settings *settings, const glssao_plan *plan);

/* tiles.c */
void glssao__tiles_size(int width, int height, int *out_columns, int *out_rows);
/* Why tiles are not sorted where the estimate has this size; NULL where they are. */
const char *glssao__tiles_refusal(const glssao_effect *effect, const glssao_settings *settings, int width, int height);
unsigned glssao__tiles_variant(const glssao_settings *settings);
/* In how many tiles around one that needs an estimate passes that read so many pixels find something to do. */
int glssao__tiles_rings(int reach);
void glssao__tiles_fill_constants(glssao__frame_constants *c, const glssao_settings *settings, int rings);
void glssao__tiles_run(glssao_effect *effect, const glssao__tile_programs *programs);
/* The program in use draws tiles that are `least` to `most` away from one that needs an estimate, until the next
 * glssao__draw_use, over a target that has `factor` pixels to one of the estimate. */
void glssao__tiles_select(glssao_effect *effect, const glssao__program_object *program, int factor, int least,
                          int most);
void glssao__tiles_destroy(glssao_effect *effect);

/* state.c: saves what the passes touch, then sets what they need; and puts all of it back. */
void glssao__state_save(const glssao__gl *gl, glssao__host_state *out_state);
void glssao__state_restore(const glssao__gl *gl, const glssao__host_state *state);
/* Blends colour with these factors; alpha stays. */
void glssao__state_set_blend(const glssao__gl *gl, gl_enum source, gl_enum destination);
/* Keeps drawing within x, y, width, height; NULL: no longer. */
void glssao__state_set_scissor(const glssao__gl *gl, const gl_int box[4]);
void glssao__state_set_viewport(const glssao__gl *gl, const gl_float viewport[4]);

/* draw.c */
void glssao__draw_bind(const glssao_effect *effect, enum glssao__unit unit, gl_uint texture,
                       enum glssao__sampler sampler);
void glssao__draw_use(glssao_effect *effect, const glssao__program_object *program);
/* Covers width x height of the framebuffer with the program in use, which is none of compute shaders. */
void glssao__draw(glssao_effect *effect, gl_uint framebuffer, int width, int height);
/* The same for a target, by compute shader where the program is one, but draws no pixel outside of the region. */
void glssao__draw_region(glssao_effect *effect, const glssao__target *target, const glssao__region *region);
/* Draws the region of maps of width x height into a target of the region's size. */
void glssao__draw_crop(glssao_effect *effect, const glssao__target *target, int width, int height,
                       const glssao__region *region);
bool glssao__draw_is_between_normals(const glssao_effect *effect, const char *function); /* logs it, too */
/* With GLSSAO_CHECK_GL only: names the pass after which the driver holds an error. Eats errors of the host. */
void glssao__draw_check(const glssao_effect *effect, const char *where);

/* compute.c */
/* Why the passes of the frame that could run as compute shaders do or don't. */
bool glssao__compute_decide(const glssao_effect *effect, const glssao_settings *settings, const char **out_reason);
/* Whether no frame of the effect runs any. */
bool glssao__compute_is_out(const glssao_effect *effect);
bool glssao__compute_can_run(const glssao_settings *settings, glssao_pass pass);
/* Whether the frame is to be tried again without, after its programs could not be made. */
bool glssao__compute_gives_up(glssao_effect *effect, const glssao_plan *plan, glssao_result result);
/* Of the blur's rounds, those that run within the dispatch that brings the result to full size. */
int glssao__compute_rounds_within(const glssao_settings *settings, const glssao_plan *plan);
/* The program in use writes the region of the target. */
void glssao__compute_dispatch(glssao_effect *effect, const glssao__target *target, const glssao__region *region);
/* What was dispatched can be read, and drawn over, by whatever follows; nothing where nothing was. */
void glssao__compute_finish(glssao_effect *effect);

/* accumulate.c */
/* The settings that one more estimate is computed with: at full size. */
glssao_settings glssao__accumulate_settings(const glssao_settings *settings);
/* How many estimates there are with the next; 1 where this is another view than before. */
int glssao__accumulate_next(const glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings);
/* Counts the next estimate; clears the sums before the first. */
void glssao__accumulate_begin(glssao_effect *effect, const glssao_frame *frame, const glssao_settings *settings);
void glssao__accumulate_fill_constants(const glssao_effect *effect, const glssao__region *probed,
                                       glssao__frame_constants *c);
void glssao__accumulate_probe(glssao_effect *effect, const glssao__program_object *program);
double glssao__accumulate_error(glssao_effect *effect);
void glssao__accumulate_stop(glssao_effect *effect); /* the next estimate is the first */
void glssao__accumulate_destroy(glssao_effect *effect);

/* inputs.c */
/* Refuses textures that are not what the frame says. */
glssao_result glssao__inputs_check(glssao_effect *effect, const glssao_frame *frame, glssao__precision *out_precision);
int glssao__inputs_count(const glssao_frame *frame); /* how many of the textures must be copied */
glssao_result glssao__inputs_fit(glssao_effect *effect, const glssao_frame *frame);
/* The frame as the passes after the copying see it. */
glssao_frame glssao__inputs_frame(const glssao_effect *effect, const glssao_frame *frame);
glssao_result glssao__inputs_programs(glssao_effect *effect, const glssao_frame *frame,
                                      glssao__program_object out_programs[INPUT_COUNT]);
void glssao__inputs_copy(glssao_effect *effect, const glssao_frame *frame,
                         const glssao__program_object programs[INPUT_COUNT]);

/* maps.c */
glssao_result glssao__maps_make_ambient(glssao_effect *effect, int width, int height, glssao__ambient_maps *out_maps);
void glssao__maps_delete_ambient(const glssao__gl *gl, glssao__ambient_maps *maps);
glssao_result glssao__maps_make_normal(glssao_effect *effect, int width, int height, glssao__target *out_map);
/* Makes or remakes the map where it has another size; on failure it is as it was. */
glssao_result glssao__maps_fit_input(glssao_effect *effect, bool has_normals, glssao__target *map);
glssao_result glssao__maps_fit_block(glssao_effect *effect, int width, int height);
glssao_result glssao__maps_fit_distance(glssao_effect *effect, int width, int height, bool has_layers);
glssao_result glssao__maps_fit_accumulation(glssao_effect *effect);
/* The ambient maps, the paired ones and the result's own (width 0: neither is needed), all or none. */
glssao_result glssao__maps_fit_results(glssao_effect *effect, int width, int height, bool paired, int result_width,
                                       int result_height);
void glssao__maps_delete_target(const glssao__gl *gl, glssao__target *target);
/* The texture that holds the result. */
gl_uint glssao__maps_result(const glssao_effect *effect, int *out_width, int *out_height);
glssao_result glssao__maps_make_random_vector(glssao_effect *effect);
glssao_result glssao__maps_fit_tiles(glssao_effect *effect, int width, int height, bool from_depth);
void glssao__maps_clear_result(glssao_effect *effect);
/* 1 into all maps that the frame's passes after the tiles draw into. */
void glssao__maps_clear_all(glssao_effect *effect);
void glssao__maps_make_samplers(glssao_effect *effect);
glssao_result glssao__maps_check_texture(glssao_effect *effect, gl_uint texture, bool needs_depth, const char *field);

/* program_sources.c */
enum {
    GLSSAO__PROGRAM_MAX_SOURCES = 3 * VARIANT_FLAGS + 16
}; /* three a macro, ten about versions, blocks and sizes, six files */
/* Pieces of a shader stage of a variant, in the order that the driver gets them; returns how many. `gl` NULL: for a
 * driver that knows GLSL 3.30, or 4.30 for compute shaders, and nothing beyond. */
int glssao__program_sources(const glssao__gl *gl, enum glssao__shader shader, unsigned variant, gl_enum stage,
                            const char *out_sources[GLSSAO__PROGRAM_MAX_SOURCES]);
/* What the shader tests. */
unsigned glssao__program_flags(enum glssao__shader shader);
/* False where the shader does not test one of the flags, or they exclude each other. */
bool glssao__program_exists(enum glssao__shader shader, unsigned variant);
const char *glssao__program_shader_name(enum glssao__shader shader);
/* Without the flags that the shader does not test, or that change nothing, and with those that the driver is to have.
 */
unsigned glssao__program_variant(enum glssao__shader shader, unsigned variant, bool is_software);
/* Pixels of the target that a work group makes. */
void glssao__program_group(enum glssao__shader shader, unsigned variant, int out[2]);

/* program.c */
/* The program, compiled on first use; flags that the shader does not test are dropped. */
glssao_result glssao__program_get(glssao_effect *effect, enum glssao__shader shader, unsigned variant,
                                  glssao__program_object *out);

/* cache.c: a linked program from the host's folder, 0 where there is none; and one put there. */
gl_uint glssao__cache_read(const glssao_effect *effect, enum glssao__shader shader, unsigned variant);
void glssao__cache_write(const glssao_effect *effect, enum glssao__shader shader, unsigned variant, gl_uint program);

/* frame_programs.c */
typedef struct glssao__frame_programs {
    glssao__program_object inputs[INPUT_COUNT], normals, distance, estimate, open, resolve, probe, upsample, spread;
    glssao__program_object blur, wide_blur, last_blur; /* the first round's, later ones', that of the last call */
    glssao__tile_programs tiles;
} glssao__frame_programs;

/* Compiles what the plan needs, before anything changes. `host` is the host's frame, `frame` what the passes after the
 * copying of inputs see. */
glssao_result glssao__frame_programs_get(glssao_effect *effect, const glssao_frame *host, const glssao_frame *frame,
                                         const glssao_settings *settings, const glssao_plan *plan,
                                         glssao__frame_programs *out);

/* stats.c */
void glssao__stats_begin_frame(glssao_effect *effect);
void glssao__stats_begin_pass(glssao_effect *effect, glssao_pass pass);
void glssao__stats_end_pass(glssao_effect *effect, glssao_pass pass, int draw_calls);
void glssao__stats_make_timers(glssao_effect *effect);
extern const char *const glssao__stats_pass_names[GLSSAO_PASS_COUNT];

#endif
