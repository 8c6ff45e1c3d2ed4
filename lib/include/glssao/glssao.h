/* SPDX-License-Identifier: MIT
 *
 * glssao: screen-space ambient occlusion for OpenGL 3.3 and later.
 *
 * It turns a depth map and view-space normals of your frame into an accessibility map (1: open, 0: fully
 * occluded), or multiplies that map into your picture. It does not open windows, make contexts, load models
 * or draw your scene. It has no global state and needs no library: you hand it a GL function loader.
 *
 * Rules for every call (docs/integration.md says more about contexts, state and errors)
 *   Context    The effect's GL context is current on the calling thread: 3.3 or later, core or compatibility. One thread at a
 *              time uses an effect. Contexts that share objects may exchange textures with it, after glFinish or a fence.
 *   State      Each call leaves GL state as it found it, unless config.host_restores_state is set. Conditional rendering and
 *              transform feedback must be off.
 *   Errors     A call that fails changes nothing, says why in one line of the log, and leaves the effect usable. A NULL
 *              effect gives GLSSAO_INVALID_ARGUMENT, 0 or NULL, as the type allows. No call leaves a GL error behind.
 *   Ownership  Structs handed in are copied. The effect deletes only what it created.
 *   Growth     Later versions add fields at the end of a struct; 0 keeps today's meaning. Zero a struct before you fill it, or
 *              use its default function.
 *
 * Spaces: view space has the camera at its origin, is right-handed, and looks down -z; view distance is -z.
 * Window depth is what the depth buffer stores, 0 to 1. uv is 0 to 1 with its origin at the bottom left.
 */
#ifndef GLSSAO_H
#define GLSSAO_H

#include <stdbool.h>
#include <stdint.h>

/* The version of this header; glssao_version() returns that of the library. */
#define GLSSAO_VERSION_MAJOR 0
#define GLSSAO_VERSION_MINOR 2
#define GLSSAO_VERSION_PATCH 0

#if defined(_WIN32) && defined(GLSSAO_SHARED)
#if defined(GLSSAO_BUILD)
#define GLSSAO_API __declspec(dllexport)
#else
#define GLSSAO_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define GLSSAO_API __attribute__((visibility("default")))
#else
#define GLSSAO_API /* before each public function */
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- results and log ------------------------------------------------------------------------------------ */

typedef struct glssao_effect glssao_effect; /* one per GL context; opaque */

typedef enum glssao_result { /* what a call that can fail gives */
    GLSSAO_OK = 0,
    GLSSAO_INVALID_ARGUMENT,    /* the log names the field and its value */
    GLSSAO_UNSUPPORTED_CONTEXT, /* older than 3.3, or it lacks a function or what config.path asks for */
    GLSSAO_OUT_OF_MEMORY,
    GLSSAO_SHADER_ERROR,        /* the log holds the driver's text and the numbered source */
    GLSSAO_FRAMEBUFFER_ERROR    /* the driver refuses one of the formats or attachments */
} glssao_result;

/* How much a message matters. */
typedef enum glssao_log_level { GLSSAO_LOG_ERROR = 0, GLSSAO_LOG_WARNING, GLSSAO_LOG_INFO } glssao_log_level;

/* A GL function of any type. */
typedef void (*glssao_proc)(void);
/* Finds the GL function `name` ("glClear"); NULL where there is none. */
typedef void *(*glssao_load_fn)(const char *name, void *user);
/* Takes one message, which is valid during the call only. It must not call the effect. */
typedef void (*glssao_log_fn)(glssao_log_level level, const char *message, void *user);

/* ---- config: fixed for the effect's life ---------------------------------------------------------------- */

/* How passes run that can be drawn or dispatched: distance, horizon's estimate, blurs and upsampling. The two ways differ
 * by no more than an eye can see: RMSE at most 1e-4, at most 1 pixel in 10,000 by more than 0.02. */
typedef enum glssao_path {
    GLSSAO_PATH_AUTO = 0, /* compute shaders on GPUs that have and take them; fragment shaders on software rasterisers */
    GLSSAO_PATH_FRAGMENT, /* never compute shaders */
    GLSSAO_PATH_COMPUTE   /* compute shaders, or UNSUPPORTED_CONTEXT where they can't write images */
} glssao_path;

typedef struct glssao_config { /* zero means default */
    glssao_load_fn load; /* this or get_proc is required: finds GL functions */
    void *load_user;     /* handed to load */
    glssao_log_fn log;   /* NULL: silent */
    void *log_user;      /* handed to log */
    int width, height;   /* full size in pixels: that of the depth maps handed over. 1 to GL_MAX_TEXTURE_SIZE */
    uint32_t seed;       /* of classic's vectors, hemisphere's kernel and glssao_accumulate's noise: same seed, same bits */
    bool no_timers;      /* true: no timer queries; glssao_stats then holds no times */
    const char *program_cache; /* a folder where linked programs are kept for the next run; NULL: none. It must exist, belong
                            to the user, and be writable by nobody else; otherwise the log warns and nothing is kept */
    glssao_path path;    /* compute shaders or fragment shaders, where both can do it */
    glssao_proc (*get_proc)(const char *name); /* instead of load: glfwGetProcAddress, eglGetProcAddress and SDL's fit */
    bool host_restores_state; /* true: calls neither query GL state nor restore it, and check less; docs/integration.md lists
                            what they change */
} glssao_config;

/* ---- settings: may change every frame ------------------------------------------------------------------- */

typedef enum glssao_technique { /* how occlusion is estimated */
    GLSSAO_CLASSIC = 0, /* 14 offsets about the point, distance fade, bilateral blur (Luna, D3D12 book, ch. 21) */
    GLSSAO_HEMISPHERE,  /* samples in the half ball about the normal, 4x4 tile of rotations (Chapman 2013) */
    GLSSAO_HORIZON,     /* cosine-weighted visibility by slices: nearest to ray-traced truth (Jimenez 2016, Therrien 2023) */
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

typedef enum glssao_tiles { /* whether the effect looks for tiles where nothing can occlude, and leaves them out */
    GLSSAO_TILES_AUTO = 0,  /* where it can pay: on software rasterisers, unless the picture is small */
    GLSSAO_TILES_OFF,
    GLSSAO_TILES_ON
} glssao_tiles;

typedef struct glssao_settings {   /* fill with glssao_default_settings() first, then change what you like */
    glssao_technique technique;    /* decides which of the fields below count */
    float radius;                  /* scene units, >= 0: how far away an occluder can be. 0 occludes nothing */
    float fade_start, fade_end;    /* scene units of view distance, 0 <= start <= end (classic): an occluder that is nearer
                                      than the point by start counts fully, by end not at all */
    float surface_epsilon;         /* scene units, >= 0: an occluder counts only if it is nearer than the point (classic) or
                                      than the sample (hemisphere) by more than this. horizon, rays: depths that differ by
                                      less are taken for one surface (noise of scans, point clouds, edge lines); 0 */
    float power;                   /* 0 to 64: accessibility is raised to this; more is darker */
    int sample_count;              /* classic: 1 to 14 offsets; hemisphere: 1 to 64; horizon: depths, 12 (one slice of 6 a
                                      side), 16 (1 x 8), 24 (1 x 12), 32 (2 x 8), 48 (2 x 12) or 64 (2 x 16); rays: 1 to 64
                                      that a texel of rays_texture stands for, which only the host reads */
    bool half_resolution;          /* estimate at half the size, (w + 1) / 2 by (h + 1) / 2 */
    bool upsample;                 /* true: a half-size result is brought to full size along surfaces */
    glssao_blur blur;              /* of the estimate, before upsampling */
    int blur_rounds;               /* 0 to 16: each is a horizontal and a vertical pass; planar: after the first, one */
    float blur_sigma;              /* pixels of the ambient map, above 0 to 2.5 */
    float blur_normal_threshold;   /* cosine, -1 to 1: taps whose normals' dot product is below are dropped */
    float blur_depth_threshold;    /* scene units, >= 0: taps farther off in view distance are dropped */
    glssao_tiles tiles;            /* the picture is the same with and without, within a step of R16 */
    /* For teaching: */
    bool no_angle_weight;          /* classic: occluders count at any angle, so flat surfaces darken */
    /* Over time: */
    uint32_t noise_index;          /* another pattern of noise for each value, for instance the number of the frame where
                                      the host averages frames itself (TAA); 0: the pattern of docs/decisions/0028 */
    int history;                   /* 0 to 63: earlier frames that count in a pixel's mean at most; 0: none. The result has the
                                      full size. Needs frame.view; not with bent normals. See docs/integration.md */
    /* How far occlusion reaches: */
    float thickness;               /* horizon: multiplies the estimated thickness of occluders, 0.001 to 1000; 0: 1. A second
                                      layer's is kept */
    float fade_far_start, fade_far_end; /* scene units of view distance, 0 <= start <= end: occlusion is full up to start and
                                      fades to nothing at end. 0, 0: never */
    bool radius_in_pixels;         /* radius counts pixels of the full size, as wide as they are where the point lies */
    bool bent_normals;             /* horizon: also write GLSSAO_MAP_BENT_NORMAL. Not with frame.rays_texture, whose rays tell
                                      no directions */
} glssao_settings;

/* ---- frame: what the host hands over each time ---------------------------------------------------------- */

typedef enum glssao_depth { /* what a texel of depth means */
    GLSSAO_DEPTH_WINDOW = 0,    /* what the depth buffer stores; depth or depth-stencil format */
    GLSSAO_DEPTH_VIEW_DISTANCE, /* view distance in the red channel of a float format; sky: 0, infinite or no number */
    GLSSAO_DEPTH_NORMAL_ALPHA,  /* the same in the alpha of normal_texture; depth_texture is not used */
    GLSSAO_DEPTH_LOGARITHMIC    /* log(c t + 1) / log(c far + 1) at view distance t, sky at 1; depth or red of a float
                                   format; frame.log_depth_far and _constant. Copied first, see frame.multisample */
} glssao_depth;

typedef enum glssao_normal { /* how a texel stores a normal */
    GLSSAO_NORMAL_SIGNED = 0, /* xyz in -1..1, any length but 0 */
    GLSSAO_NORMAL_UNSIGNED,   /* xyz stored as 0..1 */
    GLSSAO_NORMAL_OCTAHEDRAL  /* red and green, -1..1 (Meyer et al. 2010) */
} glssao_normal;

typedef struct glssao_frame { /* zero a field that you don't use */
    uint32_t depth_texture;    /* GL_TEXTURE_2D of the effect's full size, level 0; may stay attached to a framebuffer */
    glssao_depth depth_kind;   /* of depth_texture */
    uint32_t normal_texture;   /* GL_TEXTURE_2D of the full size, view space unless world_normals; 0: rebuilt from depth
                                  (one more pass) */
    glssao_normal normal_kind; /* of normal_texture */
    float projection[16];      /* column-major clip_from_view, finite and invertible: perspective (off-centre, infinite,
                                  reversed: all fine) or orthographic (the eye may lie inside the depth range), mirrored or
                                  turned about the view axis too. Window depth under an oblique near plane is copied first */
    bool clip_zero_to_one;     /* true where the host called glClipControl(..., GL_ZERO_TO_ONE) */
    int margin;                /* pixels on each side, even: they hold occluders beyond the picture's edge and are not part
                                  of the result, which is that much smaller. projection is that of the whole */
    bool no_ambient_light;     /* true: there is no light that the result could scale. Nothing is drawn, the result is 1 */
    bool only_sky;             /* true: only sky is seen. The same */
    uint32_t back_texture;     /* horizon: the nearest back face (or two-sided surface) at or behind the visible surface */
    uint32_t second_texture;   /* horizon: the nearest front face behind that. Both or neither, stored as depth_texture; view
                                  distance in red where depth is in the normal map; the sky value where there is none.
                                  Thickness is then measured instead of estimated */
    float log_depth_far;       /* GLSSAO_DEPTH_LOGARITHMIC: view distance at depth 1, scene units, 1e-12 to 1e12 */
    float log_depth_constant;  /* GLSSAO_DEPTH_LOGARITHMIC: c, 1e-12 to 1e12; 0: 1, which is what three.js has */
    bool multisample;          /* true: the textures are GL_TEXTURE_2D_MULTISAMPLE; each pixel's first sample is read. Each
                                  texture is copied: one pass, and 4 bytes a pixel, or 16 of normals, until the next resize */
    int viewport[4];           /* x, y, width, height, pixels: where the picture lies in larger textures; width and height
                                  are the effect's full size. Each texture is copied, as above. All 0: the whole texture */
    float view[16];            /* view_from_world, column-major; for world_normals, and where settings.history > 0 */
    uint32_t motion_texture;   /* settings.history > 0, optional: float format, full size. Red and green: the point's uv now
                                  minus its uv in the last frame, camera included. Outside -2..2: view tells it */
    bool cut;                  /* settings.history > 0: nothing of the earlier frames holds */
    bool world_normals;        /* true: normal_texture is in world space. view turns each normal as it is read */
    uint32_t rays_texture;     /* optional, R8, R16, R16F or R32F, full or half size (a texel belongs to the lower left of four
                                  pixels). Red: unbiased linear accessibility from a few rays; negative, NaN: none there.
                                  Corrects the technique's result, or is all of it (GLSSAO_RAYS): docs/integration.md */
} glssao_frame;

/* ---- apply: how the result gets into a picture ---------------------------------------------------------- */

typedef struct glssao_apply_options { /* fill with glssao_default_apply_options() first */
    uint32_t framebuffer;      /* 0: the default one. Draw buffer 0 is multiplied */
    int rectangle[4];          /* x, y, width, height in pixels of the framebuffer, which the result is stretched over. All 0:
                                  where frame.viewport has the picture, else the lower left corner */
    float intensity;           /* 0 none to 1 full (default) */
    float color[3];            /* 0 to 65504: what full occlusion turns the picture into. Black by default */
    uint32_t strength_texture; /* optional, lies as frame.depth_texture, or as the framebuffer of glssao_compute_framebuffer.
                                  Red: 0 keeps a pixel free of occlusion, 1 is full strength */
    bool keep_scissor, keep_stencil; /* the host's tests stay on, with all that belongs to them */
    uint32_t albedo_texture;   /* optional, lies as that. Rgb, linear: the surface's diffuse colour. Adds light that bounced off
                                  neighbours of the same colour (Jimenez et al. 2016, section 5) */
    bool show;                 /* true: accessibility replaces the picture. For a first look */
} glssao_apply_options;

/* ---- what the effect tells ------------------------------------------------------------------------------ */

typedef enum glssao_map_id { /* textures to look at */
    GLSSAO_MAP_AMBIENT = 0,   /* the result: accessibility in red, R16; half size where it was estimated so and not upsampled */
    GLSSAO_MAP_AMBIENT_OTHER, /* the second of the two ping-pong maps, with what the blur last drew into it: accessibility in
                                 red, R16; RG32F or RGBA32F after some passes, see docs/conventions.md */
    GLSSAO_MAP_NORMAL,        /* the effect's own normal map, RGBA16F, full size */
    GLSSAO_MAP_RANDOM_VECTOR, /* RGBA8, 256 x 256 */
    GLSSAO_MAP_DEPTH,         /* the host's depth texture as last handed over; 0 before the first */
    GLSSAO_MAP_TILES,         /* R32F, one texel a tile: its distance in tiles from the nearest estimated one, over 16. None
                                 where the last frame had no tiles */
    GLSSAO_MAP_REBUILT_NORMAL, /* normals that the last frame rebuilt from depth: RG32F, octahedral, view space, of the
                                 estimate's size. None before one */
    GLSSAO_MAP_BENT_NORMAL    /* with settings.bent_normals, else none: RGBA16F, of the result's size. rgb: view-space mean of
                                 the open directions, weighted by their cosine with the normal, unit length; alpha: the
                                 result. How to light with it: docs/integration.md */
} glssao_map_id;

/* The uniform block cbSsao, std140, with the D3D12 demo's members and names. Matrices are column-major. */
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

typedef enum glssao_pass { /* in the order of the frame */
    GLSSAO_PASS_INPUTS = 0,  /* copies multisample, larger or logarithmic textures to plain ones. The copy of
                                glssao_compute_framebuffer counts in its time alone */
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
    double sampling_error;   /* accessibility, RMS over visible surfaces: how far glssao_accumulate's mean is from that of
                                endless estimates, as estimated; negative: not known (yet) */
    glssao_pass_stats passes[GLSSAO_PASS_COUNT]; /* indexed by glssao_pass */
    uint64_t timed_frame;    /* the newest frame whose times the GPU has finished; 0: none. Frames go untimed while four wait */
} glssao_stats;

/* ---- functions ------------------------------------------------------------------------------------------ */

/* Makes an effect in the current context, with its maps, programs and random inputs; *out_effect is NULL on any
 * failure. Fails with every glssao_result. Checks the driver's offsets of cbSsao against glssao_constants. */
GLSSAO_API glssao_result glssao_create(const glssao_config *config, glssao_effect **out_effect);

/* Deletes everything that the effect made; the context must still be current. NULL is fine. */
GLSSAO_API void glssao_destroy(glssao_effect *effect);

/* Sets a new full size in pixels and makes the maps anew; on failure the old ones stay. May fail with
 * INVALID_ARGUMENT, OUT_OF_MEMORY, FRAMEBUFFER_ERROR. Texture names returned earlier by glssao_map are no longer valid. */
GLSSAO_API glssao_result glssao_resize(glssao_effect *effect, int width, int height);

/* Settings that suit the technique. Out-of-range arguments count as GLSSAO_CLASSIC and GLSSAO_HIGH. */
GLSSAO_API glssao_settings glssao_default_settings(glssao_technique technique, glssao_quality quality);

/* For hosts without normals of their own: binds the effect's normal map and your depth texture (depth or depth-stencil format,
 * full size) as the draw framebuffer with a viewport of the full size. Clears normals to (0, 0, 1, 0), depth to your glClearDepth
 * value. Draw opaque geometry with view-space normals in output 0, call glssao_end_normals, and hand over GLSSAO_MAP_NORMAL as
 * normal_texture. May fail with INVALID_ARGUMENT and FRAMEBUFFER_ERROR. */
GLSSAO_API glssao_result glssao_begin_normals(glssao_effect *effect, uint32_t depth_texture);
/* Restores the framebuffer and viewport that were there before glssao_begin_normals. INVALID_ARGUMENT without one, or where
 * another framebuffer is bound: pairs of several effects end in reverse order. */
GLSSAO_API glssao_result glssao_end_normals(glssao_effect *effect);

/* Runs the passes of glssao_plan_frame; the result is GLSSAO_MAP_AMBIENT. May fail with INVALID_ARGUMENT, and with
 * the rest when a map or program needed for the first time can't be made. */
GLSSAO_API glssao_result glssao_compute(glssao_effect *effect, const glssao_frame *frame,
                                        const glssao_settings *settings);

/* For hosts without a depth texture: copies the depth of `framebuffer` (0: the default one), of any format and any number of
 * samples, follows its size, and runs glssao_compute. frame.viewport is the part to copy, which glssao_apply then covers; all 0:
 * that of glViewport. frame.depth_texture is 0, the other textures have that part's size. May fail as glssao_resize and
 * glssao_compute, and with FRAMEBUFFER_ERROR. */
GLSSAO_API glssao_result glssao_compute_framebuffer(glssao_effect *effect, uint32_t framebuffer, const glssao_frame *frame,
                                                    const glssao_settings *settings);

/* Compiles the shaders and allocates the textures that glssao_compute will need for these arguments, for instance while a
 * level loads. Draws nothing. May fail as glssao_compute. */
GLSSAO_API glssao_result glssao_prepare(glssao_effect *effect, const glssao_frame *frame,
                                        const glssao_settings *settings);

/* For the horizon technique and a still view: adds one full-resolution estimate, with new noise, to a running mean, which is the
 * result. The mean starts anew after glssao_compute, glssao_resize and glssao_restart_accumulation, and when frame, radius or
 * sample_count differ from the last call's. half_resolution and upsample are ignored; a history stays as it was. The planar blur
 * smooths a mean of fewer than 16 estimates, unless blur is GLSSAO_BLUR_NONE. May fail as glssao_compute. */
GLSSAO_API glssao_result glssao_accumulate(glssao_effect *effect, const glssao_frame *frame,
                                           const glssao_settings *settings);

/* Makes the next glssao_accumulate start anew. Call it when the contents of the textures changed. */
GLSSAO_API void glssao_restart_accumulation(glssao_effect *effect);

/* Multiplies accessibility into the colour (alpha stays) of draw buffer 0 of `framebuffer` (0: the default one), with the default
 * options below. This darkens direct light too; to be exact, sample the map in your own shader and scale ambient light alone.
 * Needs a glssao_compute before. Ignores scissor, stencil and colour mask; the log says so once. Follows GL_FRAMEBUFFER_SRGB.
 * Fails with INVALID_ARGUMENT where `framebuffer` does not exist or shows a texture that is read, else with FRAMEBUFFER_ERROR. */
GLSSAO_API glssao_result glssao_apply(glssao_effect *effect, uint32_t framebuffer);

/* Full intensity and black, without textures, into the default framebuffer. */
GLSSAO_API glssao_apply_options glssao_default_apply_options(void);

/* As glssao_apply, with options. Some compile another program the first time, and may fail with SHADER_ERROR. */
GLSSAO_API glssao_result glssao_apply_with(glssao_effect *effect, const glssao_apply_options *options);

/* The texture's name, and its size if the pointers are not NULL. Valid until the next resize or destroy, or until a compute,
 * prepare or accumulate with another size of the estimate makes the map anew. 0, and sizes of 0, where there is no such map. */
GLSSAO_API uint32_t glssao_map(const glssao_effect *effect, glssao_map_id id, int *out_width, int *out_height);

/* The block as last uploaded. The pointer is valid as long as the effect. */
GLSSAO_API const glssao_constants *glssao_get_constants(const glssao_effect *effect);

/* What glssao_compute would do with these arguments. All passes are skipped where it would refuse them. */
GLSSAO_API glssao_plan glssao_plan_frame(const glssao_effect *effect, const glssao_frame *frame,
                                         const glssao_settings *settings);

/* Counts of the last frame, and the newest times and error that the GPU has finished. Call glFinish first to have those of the
 * last frame. Never waits. */
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
