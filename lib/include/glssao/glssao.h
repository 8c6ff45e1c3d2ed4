/* SPDX-License-Identifier: MIT
 *
 * glssao: screen-space ambient occlusion for OpenGL 3.3 and later.
 *
 * It turns your frame's depth map and, if you have them, its normals into an accessibility map (1: open, 0: fully
 * occluded), or multiplies that map into your picture. It does not open windows, make contexts, load models or draw
 * your scene. It has no global state and links no GL library: you hand it a function that finds GL functions.
 *
 * Rules for every call (docs/integration.md explains them, docs/conventions.md lists texture formats)
 *   Context    The effect's GL context, core or compatibility, is current on the calling thread. One thread at a time
 *              uses an effect. Contexts that share objects may exchange textures with it, after glFinish or a fence.
 *   State      Each call leaves GL state as it found it, unless config.host_restores_state is set. Conditional
 *              rendering and transform feedback must be off.
 *   Errors     A call that fails changes nothing, says why in one line of the log, and leaves the effect usable. A NULL
 *              effect gives GLSSAO_INVALID_ARGUMENT, 0 or NULL, as the type allows. No call leaves a GL error behind.
 *   Ownership  Structs handed in are copied. The effect deletes only what it created.
 *   Growth     Later versions add fields at the end of a struct; 0 keeps today's meaning. Zero a struct before you fill
 *              it, or use its default function.
 *
 * Spaces: view space has the camera at its origin, is right-handed, and looks down -z; view distance is -z. Window
 * depth is what the depth buffer stores, 0 to 1. uv is 0 to 1 from the bottom left. Matrices are column-major.
 */
#ifndef GLSSAO_H
#define GLSSAO_H

#include <stdbool.h>
#include <stdint.h>

/* The version of this header; glssao_version() returns that of the library. */
#define GLSSAO_VERSION_MAJOR 0
#define GLSSAO_VERSION_MINOR 2
#define GLSSAO_VERSION_PATCH 0

#if defined(_WIN32) && defined(GLSSAO_SHARED) && defined(GLSSAO_BUILD)
#define GLSSAO_API __declspec(dllexport)
#elif defined(_WIN32) && defined(GLSSAO_SHARED)
#define GLSSAO_API __declspec(dllimport)
#elif defined(__GNUC__)
#define GLSSAO_API __attribute__((visibility("default")))
#else
#define GLSSAO_API /* before each public function */
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- results and log ------------------------------------------------------------------------------------ */

typedef struct glssao_effect glssao_effect; /* lives in one GL context; opaque */

typedef enum glssao_result { /* what a call that can fail returns */
    GLSSAO_OK = 0,
    GLSSAO_INVALID_ARGUMENT,    /* the log names the field and its value */
    GLSSAO_UNSUPPORTED_CONTEXT, /* older than 3.3, or it lacks a function or what config.path asks for */
    GLSSAO_OUT_OF_MEMORY,
    GLSSAO_SHADER_ERROR,        /* the log holds the driver's text and the numbered source */
    GLSSAO_FRAMEBUFFER_ERROR    /* the driver refuses one of the formats or attachments */
} glssao_result;

/* How much a message matters. */
typedef enum glssao_log_level { GLSSAO_LOG_ERROR = 0, GLSSAO_LOG_WARNING, GLSSAO_LOG_INFO } glssao_log_level;

typedef void (*glssao_proc)(void); /* a GL function of any type */
/* Finds the GL function `name` ("glClear"); NULL where there is none. */
typedef void *(*glssao_load_fn)(const char *name, void *user);
/* Takes one message, which is valid during the call only. It must not call the effect. */
typedef void (*glssao_log_fn)(glssao_log_level level, const char *message, void *user);

/* ---- config: fixed for the effect's life ---------------------------------------------------------------- */

typedef enum glssao_path { /* whether passes are drawn or dispatched; the results differ by an RMSE of at most 1e-4 */
    GLSSAO_PATH_AUTO = 0, /* compute shaders on GPUs that support them, fragment shaders on software rasterisers */
    GLSSAO_PATH_FRAGMENT, /* never compute shaders */
    GLSSAO_PATH_COMPUTE   /* compute shaders, or UNSUPPORTED_CONTEXT where they can't write images */
} glssao_path;

typedef struct glssao_config { /* zero means default */
    glssao_load_fn load; /* finds GL functions; this or get_proc is required */
    void *load_user;     /* handed to load */
    glssao_log_fn log;   /* NULL: silent */
    void *log_user;      /* handed to log */
    int width, height;   /* full size in pixels: that of the depth maps handed over. 1 to GL_MAX_TEXTURE_SIZE */
    uint32_t seed;       /* same seed, same bits: classic's offsets, hemisphere's kernel, glssao_accumulate's noise */
    bool no_timers;      /* true: no timer queries; glssao_stats then holds no times */
    const char *program_cache; /* folder that keeps linked programs for the next run; NULL: none. It must exist, belong
                            to the user and be writable by nobody else; otherwise the log warns and nothing is kept */
    glssao_path path;    /* compute or fragment shaders, where both can do it */
    glssao_proc (*get_proc)(const char *name); /* instead of load: that of GLFW, EGL or SDL 3 fits as it is */
    bool host_restores_state; /* true: no call queries or restores GL state; docs/integration.md lists what changes */
} glssao_config;

/* ---- settings: may change every frame ------------------------------------------------------------------- */

typedef enum glssao_technique { /* how occlusion is estimated */
    GLSSAO_CLASSIC = 0, /* 14 offsets about the point, distance fade, bilateral blur (Luna, D3D12 book, ch. 21) */
    GLSSAO_HEMISPHERE,  /* samples in the half ball about the normal, 4x4 tile of rotations (Chapman 2013) */
    GLSSAO_HORIZON,     /* cosine-weighted visibility by slices: nearest to truth (Jimenez 2016, Therrien 2023) */
    GLSSAO_RAYS         /* frame.rays_texture alone: a few rays that the host traced, denoised along surfaces */
} glssao_technique;

/* Default settings by cost: see docs/accuracy.md. */
typedef enum glssao_quality { GLSSAO_LOW = 0, GLSSAO_MEDIUM, GLSSAO_HIGH, GLSSAO_ULTRA } glssao_quality;

typedef enum glssao_blur {  /* how noise is taken out of the estimate */
    GLSSAO_BLUR_NONE = 0,
    GLSSAO_BLUR_GAUSSIAN,  /* separable, 11 taps, crosses edges */
    GLSSAO_BLUR_BILATERAL, /* the same taps, kept only where normal and view distance agree */
    GLSSAO_BLUR_BOX,       /* separable, 4 x 4: one period of the hemisphere technique's tile; crosses edges */
    GLSSAO_BLUR_PLANAR     /* separable box over a 4 x 4 tile that follows surfaces: the horizon technique's own */
} glssao_blur;

/* Tiles that nothing can occlude are found and skipped; the picture is the same within a step of R16. AUTO: on software
 * rasterisers, unless the picture is small. */
typedef enum glssao_tiles { GLSSAO_TILES_AUTO = 0, GLSSAO_TILES_OFF, GLSSAO_TILES_ON } glssao_tiles;

typedef struct glssao_settings { /* fill with glssao_default_settings() first */
    glssao_technique technique;  /* decides which of the fields below count */
    float radius;                /* scene units, >= 0: how far away an occluder can be. 0 occludes nothing */
    float fade_start, fade_end;  /* classic: scene units of view distance, 0 <= start <= end. An occluder that is nearer
                                    than the point by start counts fully, by end not at all */
    float surface_epsilon;       /* scene units, >= 0: an occluder must be nearer than the point (classic) or the sample
                                    (hemisphere) by more. horizon, rays: depths that differ by less are one surface */
    float power;                 /* 0 to 64: accessibility is raised to this; more is darker */
    int sample_count;            /* classic: 1 to 14 offsets. hemisphere: 1 to 64. horizon: depths: 12 (one slice of 6 a
                                    side), 16 (1 x 8), 24 (1 x 12), 32 (2 x 8), 48 (2 x 12), 64 (2 x 16). rays: 1 to 64
                                    for each texel of rays_texture, a number that only the host reads */
    bool half_resolution;        /* estimate at half the size, (w + 1) / 2 by (h + 1) / 2 */
    bool upsample;               /* true: a half-size result is brought to full size along surfaces */
    glssao_blur blur;            /* of the estimate, before upsampling */
    int blur_rounds;             /* 0 to 16: each is a horizontal and a vertical pass; planar: one after the first */
    float blur_sigma;            /* pixels of the ambient map, above 0 to 2.5 */
    float blur_normal_threshold; /* cosine, -1 to 1: drops taps whose normal's dot product with the pixel's is below */
    float blur_depth_threshold;  /* scene units, >= 0: drops taps that are farther off in view distance */
    glssao_tiles tiles;          /* whether tiles that nothing can occlude are skipped */
    bool no_angle_weight;        /* classic, for teaching: occluders count at any angle, so flat surfaces darken */
    uint32_t noise_index;        /* each value gives another noise pattern: the frame's number if you average frames */
    int history;                 /* 0 to 63: the most earlier frames in a pixel's mean, more where they saw more of what is
                                    around it; 0: none. Full-size result. Needs frame.view; not with bent normals */
    float thickness;             /* horizon: multiplies the estimated thickness of occluders, 0.001 to 1000; 0: 1 */
    float fade_far_start, fade_far_end; /* scene units of view distance, 0 <= start <= end: occlusion is full up to
                                    start and fades to nothing at end. 0, 0: never */
    bool radius_in_pixels;       /* radius counts pixels of the full size, as wide as they are where the point lies */
    bool bent_normals;           /* horizon: also write GLSSAO_MAP_BENT_NORMAL */
} glssao_settings;

/* ---- frame: what the host hands over each time ---------------------------------------------------------- */

typedef enum glssao_depth { /* what a texel of depth means */
    GLSSAO_DEPTH_WINDOW = 0,    /* what the depth buffer stores; depth or depth-stencil format */
    GLSSAO_DEPTH_VIEW_DISTANCE, /* view distance in the red channel of a float format; sky: 0, infinity or NaN */
    GLSSAO_DEPTH_NORMAL_ALPHA,  /* the same in the alpha of normal_texture; depth_texture is not used */
    GLSSAO_DEPTH_LOGARITHMIC    /* log(c t + 1) / log(c far + 1) at view distance t, sky at 1; depth format or red of a
                                   float format. Needs a copy, as frame.multisample does */
} glssao_depth;

typedef enum glssao_normal { /* how a texel stores a normal */
    GLSSAO_NORMAL_SIGNED = 0, /* xyz in -1..1, any length but 0 */
    GLSSAO_NORMAL_UNSIGNED,   /* xyz stored as 0..1 */
    GLSSAO_NORMAL_OCTAHEDRAL  /* red and green, -1..1 (Meyer et al. 2010) */
} glssao_normal;

typedef struct glssao_frame { /* zero a field that you don't use */
    uint32_t depth_texture;    /* GL_TEXTURE_2D of the full size, level 0; may stay attached to a framebuffer */
    glssao_depth depth_kind;   /* how it stores depth */
    uint32_t normal_texture;   /* GL_TEXTURE_2D of the full size, view space unless world_normals. 0: made from depth */
    glssao_normal normal_kind; /* how it stores normals */
    float projection[16];      /* clip_from_view, finite and invertible: any perspective or orthographic matrix whose
                                  pixels are rectangles; docs/conventions.md */
    bool clip_zero_to_one;     /* true where the host called glClipControl(..., GL_ZERO_TO_ONE) */
    int margin;                /* pixels on each side, even: they hold occluders beyond the picture's edge and are not
                                  part of the result, which is that much smaller. projection is that of the whole */
    bool no_ambient_light, only_sky; /* true: no light to scale; no surface seen. Nothing is drawn, the result is 1 */
    uint32_t back_texture;     /* horizon: the nearest back face (or two-sided surface) at or behind the visible one */
    uint32_t second_texture;   /* horizon: the nearest front face behind that. Both or neither, stored as depth_texture
                                  (view distance in red where depth is in the normal map); where there is none, the sky
                                  value. Thickness is then measured instead of estimated */
    float log_depth_far, log_depth_constant; /* GLSSAO_DEPTH_LOGARITHMIC: view distance at depth 1, scene units; and c,
                                  where 0 means 1, as in three.js. 1e-12 to 1e12 */
    bool multisample;          /* true: the textures are GL_TEXTURE_2D_MULTISAMPLE; each pixel's first sample is read.
                                  Each is copied first: one pass, and 4 bytes a pixel, or 16 of normals */
    int viewport[4];           /* x, y, width, height, pixels: where the picture lies in larger textures, which are
                                  copied as above. width and height are the full size. All 0: the whole texture */
    float view[16];            /* view_from_world; for world_normals and where settings.history > 0 */
    uint32_t motion_texture;   /* settings.history > 0, optional: float format, full size. Red and green: the point's uv
                                  now minus its uv in the last frame, camera included. Outside -2..2: view tells it */
    bool cut;                  /* settings.history > 0: drop all earlier frames */
    bool world_normals;        /* true: normal_texture is in world space. view turns each normal as it is read */
    uint32_t rays_texture;     /* optional, R8, R16, R16F or R32F, full or half size (a texel belongs to the lower left
                                  of four pixels). Red: unbiased linear accessibility from a few rays; negative, NaN:
                                  none there. Corrects the technique's result, or is all of it (GLSSAO_RAYS) */
    int rays_offset[2];        /* settings.history > 0: x, y, 0 or 1: the pixel of four that a texel of half size belongs to
                                  instead. Another one in each frame gives the mean the detail of the full size */
} glssao_frame;

/* ---- apply: how the result gets into a picture ---------------------------------------------------------- */

typedef struct glssao_apply_options { /* fill with glssao_default_apply_options() first */
    uint32_t framebuffer;      /* 0: the default one. Draw buffer 0 is multiplied */
    int rectangle[4];          /* x, y, width, height in pixels of the framebuffer, which the result is stretched over.
                                  All 0: where frame.viewport has the picture, else the lower left corner */
    float intensity;           /* 0 none to 1 full (default) */
    float color[3];            /* 0 to 65504: what full occlusion turns the picture into. Black by default */
    uint32_t strength_texture; /* optional, lies as frame.depth_texture, or as glssao_compute_framebuffer's framebuffer.
                                  Red: 0 keeps a pixel free of occlusion, 1 is full strength */
    bool keep_scissor, keep_stencil; /* the host's tests stay on, with all that belongs to them */
    uint32_t albedo_texture;   /* optional, lies as that. Rgb, linear: diffuse colour. Adds light that bounced off
                                  neighbours of the same colour (Jimenez et al. 2016, section 5) */
    bool show;                 /* true: accessibility replaces the picture. For a first look */
} glssao_apply_options;

/* ---- what the effect tells ------------------------------------------------------------------------------ */

typedef enum glssao_map_id {  /* textures to look at; docs/conventions.md lists their formats and values */
    GLSSAO_MAP_AMBIENT = 0,   /* the result: accessibility in red, R16; half size if estimated so and not upsampled */
    GLSSAO_MAP_AMBIENT_OTHER, /* the second of the two ping-pong maps: the last horizontal blur */
    GLSSAO_MAP_NORMAL,        /* the effect's own normal map, RGBA16F, full size */
    GLSSAO_MAP_RANDOM_VECTOR, /* RGBA8, 256 x 256 */
    GLSSAO_MAP_DEPTH,         /* the host's depth texture as last handed over; 0 before the first */
    GLSSAO_MAP_TILES,         /* R32F: a tile's distance in tiles from the nearest estimated one, over 16; or none */
    GLSSAO_MAP_REBUILT_NORMAL, /* normals that the last frame rebuilt from depth: RG32F, octahedral; or none */
    GLSSAO_MAP_BENT_NORMAL    /* with settings.bent_normals, else none: RGBA16F, the result's size. rgb: view-space mean
                                 of the open directions, cosine-weighted, unit length; alpha: the result */
} glssao_map_id;

/* The uniform block cbSsao, std140, with the D3D12 demo's members and names. */
typedef struct glssao_constants {
    float gProj[16];             /* clip from view */
    float gInvProj[16];          /* view from clip */
    float gProjTex[16];          /* uv from view, by way of clip: divide by w */
    float gOffsetVectors[14][4]; /* 8 cube corners, 6 face centres, each of random length in 0.25..1 */
    float gBlurWeights[3][4];    /* 11 Gaussian weights that sum to 1; the twelfth is 0 */
    float gInvRenderTargetSize[2]; /* one texel of the ambient map, in uv */
    float gOcclusionRadius, gOcclusionFadeStart, gOcclusionFadeEnd, gSurfaceEpsilon; /* scene units */
    float gPadding[2];           /* std140 rounds the block up to 496 bytes */
} glssao_constants;

typedef enum glssao_pass {   /* in the order of the frame */
    GLSSAO_PASS_INPUTS = 0,  /* copies multisample, larger or logarithmic textures to plain ones */
    GLSSAO_PASS_NORMALS,     /* rebuilds normals from depth */
    GLSSAO_PASS_DISTANCE,    /* view distance at the estimate's size */
    GLSSAO_PASS_TILES,       /* looks for tiles without any occlusion, which later passes leave out */
    GLSSAO_PASS_ESTIMATE,    /* raw accessibility */
    GLSSAO_PASS_RESOLVE,     /* glssao_accumulate: the mean of the estimates and its error */
    GLSSAO_PASS_BLUR,        /* all rounds */
    GLSSAO_PASS_RAYS,        /* corrects the estimate by the host's rays */
    GLSSAO_PASS_UPSAMPLE,    /* brings a half-size result to full size */
    GLSSAO_PASS_HISTORY,     /* the mean of this frame and earlier ones, at full size */
    GLSSAO_PASS_APPLY,       /* glssao_apply: multiplies accessibility into colour */
    GLSSAO_PASS_COUNT
} glssao_pass;

typedef struct glssao_planned_pass { /* one pass of a frame to come */
    const char *name;    /* static text, as is `reason` */
    const char *reason;  /* why it runs or is skipped, in words */
    bool run;            /* false: skipped */
    int draw_calls;      /* and dispatches; 0 where it is skipped */
    int width, height;   /* pixels that it covers, or would cover */
    bool compute;        /* true: by a compute shader */
} glssao_planned_pass;

typedef struct glssao_plan { /* GLSSAO_PASS_APPLY belongs to glssao_apply and is not planned */
    glssao_planned_pass passes[GLSSAO_PASS_COUNT]; /* indexed by glssao_pass */
    glssao_path path;        /* of passes that can be drawn or dispatched; never GLSSAO_PATH_AUTO */
    const char *path_reason; /* static text: why, in words */
} glssao_plan;

typedef struct glssao_pass_stats { /* one pass of the last frame */
    const char *name;        /* static text */
    int draw_calls;          /* and dispatches; 0 where it was skipped */
    double gpu_ms;           /* of timed_frame; negative: skipped there, or not known */
} glssao_pass_stats;

typedef struct glssao_stats { /* of the last glssao_compute or glssao_accumulate, and glssao_apply */
    uint64_t frame;          /* how many glssao_compute and glssao_accumulate calls succeeded so far */
    int draw_calls;          /* and dispatches; sum over the passes */
    double gpu_ms;           /* sum over the passes of timed_frame; negative: none is known yet */
    int estimates;           /* in the mean of glssao_accumulate; 0 after glssao_compute */
    double sampling_error;   /* of that mean: estimated RMS distance from its limit; negative: not known (yet) */
    glssao_pass_stats passes[GLSSAO_PASS_COUNT]; /* indexed by glssao_pass */
    uint64_t timed_frame;    /* the newest frame whose times the GPU has finished; 0: none */
} glssao_stats;

/* ---- functions ------------------------------------------------------------------------------------------ */

/* Makes an effect in the current context. *out_effect is NULL on any failure. May fail with every glssao_result. */
GLSSAO_API glssao_result glssao_create(const glssao_config *config, glssao_effect **out_effect);

/* Deletes everything that the effect made; the context must still be current. NULL is fine. */
GLSSAO_API void glssao_destroy(glssao_effect *effect);

/* Sets a new full size in pixels and makes the maps anew; on failure the old ones stay. May fail with INVALID_ARGUMENT,
 * OUT_OF_MEMORY, FRAMEBUFFER_ERROR. Texture names returned earlier by glssao_map are no longer valid. */
GLSSAO_API glssao_result glssao_resize(glssao_effect *effect, int width, int height);

/* Settings that suit the technique. Out-of-range arguments count as GLSSAO_CLASSIC and GLSSAO_HIGH. */
GLSSAO_API glssao_settings glssao_default_settings(glssao_technique technique, glssao_quality quality);

/* For hosts without normals: binds the effect's normal map and your depth texture (depth or depth-stencil format, full
 * size) for drawing, sets the viewport, and clears both: normals to (0, 0, 1, 0), depth to your glClearDepth value.
 * Draw opaque geometry with view-space normals in output 0, call glssao_end_normals, and hand over GLSSAO_MAP_NORMAL
 * as normal_texture. May fail with INVALID_ARGUMENT and FRAMEBUFFER_ERROR. */
GLSSAO_API glssao_result glssao_begin_normals(glssao_effect *effect, uint32_t depth_texture);
/* Restores the framebuffer and viewport that were there before glssao_begin_normals. INVALID_ARGUMENT without one, or
 * where another framebuffer is bound: pairs of several effects end in reverse order. */
GLSSAO_API glssao_result glssao_end_normals(glssao_effect *effect);

/* Runs the passes of glssao_plan_frame; the result is GLSSAO_MAP_AMBIENT. May fail with INVALID_ARGUMENT, and with
 * the rest when a map or program needed for the first time can't be made. */
GLSSAO_API glssao_result glssao_compute(glssao_effect *effect, const glssao_frame *frame,
                                        const glssao_settings *settings);

/* For hosts without a depth texture: copies the depth of `framebuffer` (0: the default one; any format, any number of
 * samples), follows its size, and runs glssao_compute. frame.viewport is the part to copy, which glssao_apply then
 * covers; all 0: that of glViewport. frame.depth_texture is 0, the other textures have that part's size. May fail as
 * glssao_resize and glssao_compute, and with FRAMEBUFFER_ERROR. */
GLSSAO_API glssao_result glssao_compute_framebuffer(glssao_effect *effect, uint32_t framebuffer,
                                                    const glssao_frame *frame, const glssao_settings *settings);

/* Compiles the shaders and allocates the textures that glssao_compute will need for these arguments, for instance while
 * a level loads. Draws nothing. May fail as glssao_compute. */
GLSSAO_API glssao_result glssao_prepare(glssao_effect *effect, const glssao_frame *frame,
                                        const glssao_settings *settings);

/* For the horizon technique and a still view: adds one full-resolution estimate, with new noise, to a running mean,
 * which is the result. The mean restarts after glssao_compute and glssao_resize, and when frame, radius or sample_count
 * change. half_resolution and upsample are ignored; a history stays as it was. May fail as glssao_compute. */
GLSSAO_API glssao_result glssao_accumulate(glssao_effect *effect, const glssao_frame *frame,
                                           const glssao_settings *settings);
/* Makes the next glssao_accumulate restart. Call it when the contents of the textures changed. */
GLSSAO_API void glssao_restart_accumulation(glssao_effect *effect);

/* Multiplies accessibility into the colour (alpha stays) of draw buffer 0 of `framebuffer` (0: the default one), with
 * the default options below. Needs a glssao_compute before. Ignores scissor, stencil and colour mask; follows
 * GL_FRAMEBUFFER_SRGB. It darkens direct light too: to avoid that, sample the map in your own shader. Fails with
 * INVALID_ARGUMENT where `framebuffer` does not exist or shows a texture that is read, else with FRAMEBUFFER_ERROR. */
GLSSAO_API glssao_result glssao_apply(glssao_effect *effect, uint32_t framebuffer);

/* Full intensity and black, without textures, into the default framebuffer. */
GLSSAO_API glssao_apply_options glssao_default_apply_options(void);
/* As glssao_apply, with options. Some compile another program the first time, and may fail with SHADER_ERROR. */
GLSSAO_API glssao_result glssao_apply_with(glssao_effect *effect, const glssao_apply_options *options);

/* The texture's name, and its size if the pointers are not NULL; 0 where there is no such map. Valid until the next
 * resize or destroy, or until a compute, prepare or accumulate with another size of the estimate makes the map anew. */
GLSSAO_API uint32_t glssao_map(const glssao_effect *effect, glssao_map_id id, int *out_width, int *out_height);

/* The block as last uploaded. The pointer is valid as long as the effect. */
GLSSAO_API const glssao_constants *glssao_get_constants(const glssao_effect *effect);

/* What glssao_compute would do with these arguments. All passes are skipped where it would refuse them. */
GLSSAO_API glssao_plan glssao_plan_frame(const glssao_effect *effect, const glssao_frame *frame,
                                         const glssao_settings *settings);

/* Counts of the last frame, and the newest times and error that the GPU has finished. Never waits; call glFinish first
 * to have those of the last frame. */
GLSSAO_API glssao_stats glssao_get_stats(glssao_effect *effect);

/* Static English text, never NULL. */
GLSSAO_API const char *glssao_result_string(glssao_result result);

/* The library's own version, major << 16 | minor << 8 | patch, which may differ from the header's macros. */
GLSSAO_API uint32_t glssao_version(void);

/* A glssao_log_fn that prints "glssao: error: ..." to stderr; `user` is ignored. */
GLSSAO_API void glssao_log_to_stderr(glssao_log_level level, const char *message, void *user);

#ifdef __cplusplus
}
#endif
#endif
