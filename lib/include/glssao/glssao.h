/* SPDX-License-Identifier: MIT
 *
 * glssao: screen-space ambient occlusion for OpenGL 3.3 and later.
 *
 * It turns a depth map and view-space normals of your frame into an accessibility map (1: open, 0: fully
 * occluded), or multiplies that map into your picture. It does not open windows, make contexts, load models
 * or draw your scene; it has no global state and needs no library: you hand it a GL function loader.
 *
 * Rules for every call
 *   Context    The GL context the effect was created in is current on the calling thread; 3.3 or later, core
 *              or compatibility. One effect belongs to one context and is used by one thread at a time. Several
 *              effects may live in one context, and several contexts run on several threads. Contexts that share
 *              objects may hand their depth and normal textures to an effect and read its maps, ordered by glFinish
 *              or a fence; the effect itself stays in its own context (framebuffers and vertex arrays aren't shared).
 *   State      GL state is left as found (docs/architecture.md lists what is saved). No transform feedback may
 *              be active, and a running occlusion query counts the effect's fragments too. In release builds
 *              glGetError is never called, so your own errors stay yours.
 *   Errors     A call that fails changes nothing, says why in one line of the log, and leaves the effect
 *              usable. A NULL effect gives GLSSAO_INVALID_ARGUMENT, 0 or NULL, as the type allows.
 *   Ownership  Structs handed in are copied. The effect deletes only what it created.
 *
 * Spaces: view space has the camera at its origin, is right-handed, and looks down -z; view distance is -z.
 * Window depth is what the depth buffer stores, 0 to 1. uv is 0 to 1 with its origin at the bottom left.
 */
#ifndef GLSSAO_H
#define GLSSAO_H

#include <stdbool.h>
#include <stdint.h>

/* Of this header; glssao_version() tells the library's. */
#define GLSSAO_VERSION_MAJOR 0
#define GLSSAO_VERSION_MINOR 1
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
    GLSSAO_UNSUPPORTED_CONTEXT, /* older than 3.3, a function of 3.3 is missing, or compute shaders that config.path
                                   requires */
    GLSSAO_OUT_OF_MEMORY,
    GLSSAO_SHADER_ERROR,        /* the log holds the driver's text and the numbered source */
    GLSSAO_FRAMEBUFFER_ERROR    /* the driver refuses one of the formats or attachments */
} glssao_result;

/* How much a message matters. */
typedef enum glssao_log_level { GLSSAO_LOG_ERROR = 0, GLSSAO_LOG_WARNING, GLSSAO_LOG_INFO } glssao_log_level;

/* Finds the GL function `name` ("glClear"); NULL where there is none. glfwGetProcAddress and the like, wrapped. */
typedef void *(*glssao_load_fn)(const char *name, void *user);
/* Takes one message, valid during the call only. It must not call the effect. */
typedef void (*glssao_log_fn)(glssao_log_level level, const char *message, void *user);

/* ---- config: fixed for the effect's life ---------------------------------------------------------------- */

/* How passes run that can run as compute shaders, too: distance, horizon's estimate, blurs and upsampling. Both ways
 * agree within a step of R16. */
typedef enum glssao_path {
    GLSSAO_PATH_AUTO = 0, /* compute shaders on GPUs that have and take them; fragment shaders on software rasterisers */
    GLSSAO_PATH_FRAGMENT, /* never compute shaders */
    GLSSAO_PATH_COMPUTE   /* compute shaders; glssao_create fails with UNSUPPORTED_CONTEXT where there are none: neither
                             OpenGL 4.3 nor ARB_compute_shader and ARB_shader_image_load_store */
} glssao_path;

typedef struct glssao_config { /* zero means default */
    glssao_load_fn load; /* required */
    void *load_user;     /* handed to load */
    glssao_log_fn log;   /* NULL: silent */
    void *log_user;      /* handed to log */
    int width, height;   /* full size in pixels: the size of the depth maps handed over. 1 to GL_MAX_TEXTURE_SIZE */
    uint32_t seed;       /* of every random input: the same seed gives the same bits */
    bool no_timers;      /* true: no timer queries; glssao_stats then holds no times */
    const char *program_cache; /* a folder that exists, where linked programs are kept for the next run if the driver
                            can (GL 4.1 or ARB_get_program_binary); NULL: none. What does not fit is compiled anew */
    glssao_path path;    /* compute shaders or fragment shaders, where both will do */
} glssao_config;

/* ---- settings: may change every frame ------------------------------------------------------------------- */

typedef enum glssao_technique { /* how occlusion is estimated */
    GLSSAO_CLASSIC = 0, /* 14 offsets about the point, distance fade, bilateral blur (Luna, D3D12 book, ch. 21) */
    GLSSAO_HEMISPHERE,  /* samples in the half ball about the normal, 4x4 tile of rotations (Chapman 2013) */
    GLSSAO_HORIZON      /* cosine-weighted visibility by slices: nearest to ray-traced truth (Jimenez 2016, Therrien 2023) */
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

typedef enum glssao_tiles { /* whether tiles of the picture where nothing can occlude are looked for and left out */
    GLSSAO_TILES_AUTO = 0,  /* where it can pay: on software rasterisers, in pictures that are not small */
    GLSSAO_TILES_OFF,
    GLSSAO_TILES_ON
} glssao_tiles;

typedef struct glssao_settings {   /* fill with glssao_default_settings() first, then change what you like */
    glssao_technique technique;    /* decides which of the fields below count */
    float radius;                  /* scene units, >= 0: how far away an occluder can be. 0 occludes nothing */
    float fade_start, fade_end;    /* scene units of view distance, 0 <= start <= end: an occluder this much nearer
                                      than the point counts fully, or no longer (classic) */
    float surface_epsilon;         /* scene units, >= 0: an occluder less than this nearer does not count: than the
                                      point (classic), than the sample (hemisphere) */
    float power;                   /* 0 to 64: accessibility is raised to this; more is darker */
    int sample_count;              /* classic: 1 to 14 offset vectors, the 8 cube corners first; hemisphere: 1 to 64;
                                      horizon: samples of depth, 12 (one slice of 6 a side), 16 (1 x 8), 24 (1 x 12),
                                      32 (2 x 8), 48 (2 x 12) or 64 (2 x 16) */
    bool half_resolution;          /* estimate at half the size, (w + 1) / 2 by (h + 1) / 2 */
    bool upsample;                 /* a half-size result is brought to full size along surfaces; else it stays half size */
    glssao_blur blur;              /* of the estimate, before upsampling */
    int blur_rounds;               /* 0 to 16: each is a horizontal and a vertical pass; planar: after the first, one */
    float blur_sigma;              /* pixels of the ambient map, above 0 to 2.5 */
    float blur_normal_threshold;   /* cosine, -1 to 1: taps whose normals' dot product is below are dropped */
    float blur_depth_threshold;    /* scene units, >= 0: taps farther off in view distance are dropped */
    glssao_tiles tiles;            /* the picture is the same with and without, within a step of R16 */
    bool no_angle_weight;          /* classic, for teaching: occluders count at any angle, so flat surfaces darken */
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
    uint32_t normal_texture;   /* GL_TEXTURE_2D of the full size, view space; 0: rebuilt from depth (one more pass) */
    glssao_normal normal_kind; /* of normal_texture */
    float projection[16];      /* column-major clip_from_view, finite and invertible: perspective (off-centre,
                                  infinite, reversed: all fine) or orthographic */
    bool clip_zero_to_one;     /* true where the host called glClipControl(..., GL_ZERO_TO_ONE) */
    int margin;                /* pixels on each side, even: drawn so that occluders beyond the picture's edge are found,
                                  but not delivered. The result is that much smaller; projection is that of the whole */
    bool no_ambient_light;     /* there is none that the result could scale: nothing is drawn, the result is 1 */
    bool only_sky;             /* nothing but sky is seen: the same */
    uint32_t back_texture;     /* horizon; both or neither. A second layer, stored as depth_texture is (view distance in */
    uint32_t second_texture;   /* red where depth is in the normal map): the nearest back face at or behind the surface
                                  seen, where surfaces that have two sides count as back faces; and the nearest front
                                  face behind it. Sky: there is none. Thickness is then read instead of guessed */
    float log_depth_far;       /* GLSSAO_DEPTH_LOGARITHMIC: view distance at depth 1, scene units, 1e-12 to 1e12 */
    float log_depth_constant;  /* GLSSAO_DEPTH_LOGARITHMIC: c, 1e-12 to 1e12; 0: 1, which is what three.js has */
    bool multisample;          /* true: the textures are GL_TEXTURE_2D_MULTISAMPLE; the first sample of each pixel is
                                  read, never a mean. Costs a copy of each texture: a pass, and 4 bytes a pixel (depth,
                                  back, second) or 16 (normals) of memory, until the next resize */
    int viewport[4];           /* x, y, width, height, pixels: where the picture lies in larger textures; width and height
                                  are the effect's full size. Costs as multisample does. All 0: nothing is larger */
} glssao_frame;

/* ---- what the effect tells ------------------------------------------------------------------------------ */

typedef enum glssao_map_id { /* textures to look at */
    GLSSAO_MAP_AMBIENT = 0,   /* the result: accessibility in red, R16; half size where it was estimated so and not upsampled */
    GLSSAO_MAP_AMBIENT_OTHER, /* the second of the two ping-pong maps: what the blur last drew into it, in red: the last
                                 horizontal blur, or a later round of the planar blur, where fragment shaders blur
                                 (compute shaders may do without it). R16; after
                                 upsampling or the planar blur RG32F, in green what is linear in the picture of a plane,
                                 and red's ten lowest bits hold the normal */
    GLSSAO_MAP_NORMAL,        /* the effect's own normal map, RGBA16F, full size */
    GLSSAO_MAP_RANDOM_VECTOR, /* RGBA8, 256 x 256 */
    GLSSAO_MAP_DEPTH,         /* the host's depth texture as last handed over; 0 before the first */
    GLSSAO_MAP_TILES          /* one texel a tile, R32F: 0: estimated; above: left out, 1/16 for each tile that lies between
                                 it and an estimated one, itself included; 0 where the last frame had no tiles */
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
    GLSSAO_PASS_INPUTS = 0,  /* multisample, larger or logarithmic textures copied to plain ones */
    GLSSAO_PASS_NORMALS,     /* normals rebuilt from depth */
    GLSSAO_PASS_DISTANCE,    /* view distance at the estimate's size */
    GLSSAO_PASS_TILES,       /* tiles without any occlusion looked for, so that later passes leave them out */
    GLSSAO_PASS_ESTIMATE,    /* raw accessibility */
    GLSSAO_PASS_RESOLVE,     /* the mean of accumulated estimates and its error, by glssao_accumulate */
    GLSSAO_PASS_BLUR,        /* all rounds */
    GLSSAO_PASS_UPSAMPLE,    /* a half-size result brought to full size */
    GLSSAO_PASS_APPLY,       /* accessibility multiplied into colour, by glssao_apply */
    GLSSAO_PASS_COUNT
} glssao_pass;

typedef struct glssao_plan { /* indexed by glssao_pass; GLSSAO_PASS_APPLY belongs to glssao_apply and is not planned */
    struct glssao_planned_pass { /* one pass of a frame */
        const char *name;    /* static text, as is `reason` */
        const char *reason;  /* why it runs or is skipped, in words */
        bool run;            /* false: skipped */
        int draw_calls;      /* or dispatches; 0 where it is skipped */
        int width, height;   /* pixels it covers */
        bool compute;        /* true: by a compute shader */
    } passes[GLSSAO_PASS_COUNT]; /* by glssao_pass */
    glssao_path path;        /* which way those go that can go both: never GLSSAO_PATH_AUTO */
    const char *path_reason; /* static text: why, in words */
} glssao_plan;

typedef struct glssao_stats { /* of the last glssao_compute or glssao_accumulate, and glssao_apply */
    uint64_t frame;          /* how many glssao_compute and glssao_accumulate calls succeeded so far */
    int draw_calls;          /* and dispatches; sum over the passes */
    double gpu_ms;           /* sum over the passes; negative: not measured, or not known yet */
    int estimates;           /* in the mean of glssao_accumulate; 0 after glssao_compute */
    double sampling_error;   /* accessibility, RMS over the surfaces seen: how far the mean of glssao_accumulate is
                                estimated to be from that of endless estimates; negative: not known (yet) */
    struct glssao_pass_stats { /* one pass of the last frame */
        const char *name;    /* static text */
        int draw_calls;      /* or dispatches; 0 where it was skipped */
        double gpu_ms;       /* negative: as above */
    } passes[GLSSAO_PASS_COUNT]; /* by glssao_pass */
} glssao_stats;

/* ---- functions ------------------------------------------------------------------------------------------ */

/* Makes an effect in the current context, with its maps, programs and random inputs; *out_effect is NULL on any
 * failure. Fails with every glssao_result. Checks the driver's offsets of cbSsao against glssao_constants. */
GLSSAO_API glssao_result glssao_create(const glssao_config *config, glssao_effect **out_effect);

/* Deletes everything that the effect made; the context must still be current. NULL is fine. */
GLSSAO_API void glssao_destroy(glssao_effect *effect);

/* Sets a new full size in pixels and makes the maps anew; on failure the old ones stay. May fail with
 * INVALID_ARGUMENT, OUT_OF_MEMORY, FRAMEBUFFER_ERROR. Map names from glssao_map are void afterwards. */
GLSSAO_API glssao_result glssao_resize(glssao_effect *effect, int width, int height);

/* Settings that suit the technique; out-of-range arguments are taken as GLSSAO_CLASSIC and GLSSAO_HIGH. */
GLSSAO_API glssao_settings glssao_default_settings(glssao_technique technique, glssao_quality quality);

/* For hosts without view-space normals of their own: binds the effect's normal map and your depth texture
 * (depth or depth-stencil format, full size) as the draw framebuffer, sets the viewport to the full size, and
 * clears both: normals to (0, 0, 1, 0), depth to your glClearDepth value. Draw your opaque geometry, writing
 * view-space normals to output 0 and sampling neither, then call glssao_end_normals, which restores framebuffers and
 * viewport.
 * Hand glssao_map(effect, GLSSAO_MAP_NORMAL, ...) to glssao_compute as normal_texture afterwards. */
GLSSAO_API glssao_result glssao_begin_normals(glssao_effect *effect, uint32_t depth_texture);
/* Restores the framebuffer and viewport of glssao_begin_normals. INVALID_ARGUMENT without one. */
GLSSAO_API glssao_result glssao_end_normals(glssao_effect *effect);

/* Runs the passes of glssao_plan_frame; the result is GLSSAO_MAP_AMBIENT. May fail with INVALID_ARGUMENT, and with
 * the rest when a map or program needed for the first time can't be made. */
GLSSAO_API glssao_result glssao_compute(glssao_effect *effect, const glssao_frame *frame,
                                        const glssao_settings *settings);

/* Makes what glssao_compute needs for these, programs above all, without drawing: compile while a level loads. May fail
 * as glssao_compute. */
GLSSAO_API glssao_result glssao_prepare(glssao_effect *effect, const glssao_frame *frame,
                                        const glssao_settings *settings);

/* Horizon, a still view: adds one more estimate, at full size and with noise of its own, to a mean that is kept in 32-bit
 * floats, and leaves the mean as the result. Its error falls to the technique's own with the number of estimates. Starts
 * anew after glssao_compute, glssao_resize and glssao_restart_accumulation, and where frame, radius or sample_count differ
 * from the last call's; it can't see that the contents of the textures changed. half_resolution and upsample are not
 * looked at; the planar blur smooths the mean of fewer than 16 estimates unless blur is GLSSAO_BLUR_NONE. Fails as
 * glssao_compute does, and with INVALID_ARGUMENT for another technique. */
GLSSAO_API glssao_result glssao_accumulate(glssao_effect *effect, const glssao_frame *frame,
                                           const glssao_settings *settings);

/* The next glssao_accumulate starts anew: for when the contents of the textures changed. */
GLSSAO_API void glssao_restart_accumulation(glssao_effect *effect);

/* Multiplies accessibility into the colour (alpha stays) of draw buffer 0 of `framebuffer` (0: the default one),
 * over the full size, less the margin, from its lower left corner. Occlusion then darkens direct light too: to be exact, sample
 * the map in your own shader and scale ambient light alone. Needs a glssao_compute before. Fails with INVALID_ARGUMENT where
 * the map itself is attached to `framebuffer`, and as glssao_compute does. */
GLSSAO_API glssao_result glssao_apply(glssao_effect *effect, uint32_t framebuffer);

/* The texture's name, and its size if the pointers are not NULL; valid until the next resize, compute (which makes
 * the ambient maps anew when half_resolution changes) or destroy. 0 and sizes of 0 where there is no such map. */
GLSSAO_API uint32_t glssao_map(const glssao_effect *effect, glssao_map_id id, int *out_width, int *out_height);

/* The block as last uploaded; the pointer lives as long as the effect. */
GLSSAO_API const glssao_constants *glssao_get_constants(const glssao_effect *effect);

/* What glssao_compute would do with these, without doing it. All passes are skipped where it would fail. */
GLSSAO_API glssao_plan glssao_plan_frame(const glssao_effect *effect, const glssao_frame *frame,
                                         const glssao_settings *settings);

/* Counts of the last frame; its times and error as soon as the GPU has them (call glFinish first to be sure). Never
 * waits. */
GLSSAO_API glssao_stats glssao_get_stats(glssao_effect *effect);

/* Static English text; never NULL. */
GLSSAO_API const char *glssao_result_string(glssao_result result);

/* Major << 16 | minor << 8 | patch of the library that runs, which may differ from the header's macros. */
GLSSAO_API uint32_t glssao_version(void);

/* A glssao_log_fn that prints "glssao: error: ..." to stderr; `user` is ignored. */
GLSSAO_API void glssao_log_to_stderr(glssao_log_level level, const char *message, void *user);

#ifdef __cplusplus
}
#endif
#endif
