// SPDX-License-Identifier: MIT
// Constants of the horizon technique that were found by experiment. The shaders, the C tests and glssao-tune all read this
// file: one #define a line, a plain number each. Lengths are in units of the radius.

// The estimate (passes/horizon.frag). glssao-tune searches most of these; PLAN, VEIL_REACH and VEIL_FAR were set by hand.
#define JUMP 0.3              // a step in height of more than this ends a run of samples ...
#define ALIKE 0.4             // ... unless the step before or after it differs by less than this: a steep surface
#define OPEN_END 1.25         // where a run ends that is not seen to end
#define RUN_WIDTH 1.0         // thickness of a run that a jump separates from the point, in units of its width
#define PLAN_WIDTH 4.0        // the same in a parallel projection, about points that face the eye ...
#define PLAN_FROM 0.75        // ... from this cosine on in part ...
#define PLAN_TO 0.9           // ... and from this one on in full
#define VEIL_ONE_LAYER 0.14   // share of what lies hidden behind occluders that counts as occluded, however deep
#define VEIL_TWO_LAYERS 0.03  // the same where a second layer is known
#define VEIL_WIDTH 0.2        // occluders thinner than this hide nothing behind them
#define VEIL_REACH 2.0        // those that are higher above the point than this, and than they are thick, veil less ...
#define VEIL_FAR 0.45         // ... their cosine counts this far from the rim of the hemisphere
#define SECOND_WIDTH 0.3      // thickness of the second layer's surfaces, in units of what is guessed for the first's
#define REACH_ON 0.2          // an occluder reaches so many steps farther than the sample that sees it
#define CALIBRATION_6 1.1     // exponent that makes up for what 6 samples a side miss
#define CALIBRATION_8 1.05    // the same for 8 samples
#define CALIBRATION_12 1.0    // the same for 12 and 16 samples

// Not searched: what rises over the tangent plane by less than this slope does not occlude, since normals are no better. It
// would hide at most 1e-4 of a cosine-weighted hemisphere.
#define LEAST_RISE 0.01

// The planar blur (shared/planar_blur.glsl).
#define BLUR_TOLERANCE 0.02   // how far off a line may be
#define BLUR_NEAR 0.1         // how far off a neighbour may be of a pixel that has no other
#define BLUR_ALONE 0.5        // how much darker than its neighbours a pixel may be that can't be smoothed
#define BLUR_ALIKE 0.2        // from this difference on a later round's taps count no more, over the root of samples
#define BLUR_HOLLOW 0.1       // how far a later round's line may bend towards the eye at its ends

// The blur of rays (shared/planar_blur.glsl).
#define RAYS_ALIKE 0.14       // difference of accessibility at which a later round's tap counts no more
#define CORRECTION_PRIOR 2.0  // taps that say that the estimate is right already, beside the 4 of a full window

// Upsampling (shared/upsample.glsl).
#define UPSAMPLE_TOLERANCE 0.02 // how far off the plane of its neighbours a pixel may be
#define UPSAMPLE_NEAR 0.1       // how far off a neighbour on the same surface may be
#define UPSAMPLE_FALL 8.0       // a neighbour's line may pass so much farther above the pixel than the best neighbour's

// Creases (shared/paired.glsl).
#define NORMAL_STEP 0.1       // step of the two coordinates of a stored normal, which reach from -1.5 to 1.6
#define CHORD 0.69            // chord of two unit normals on different sides of a crease: 41 degrees

// Reuse of earlier frames (passes/history.frag, passes/steady.frag).
#define PLANE 0.02            // how far off its plane a surface of the last frame may be, besides a pixel's width
#define TURN 0.7              // chord of two normals of one surface
#define PICKED 2.5            // weight of a pixel that was estimated itself; the four of a block have 4
#define PICKED_RAYS 3.0       // the same for rays of another pixel than in the frame before
#define LATELY 0.3            // share of a frame in the recent change
#define NOISE 0.06            // recent change that may be noise
#define DETAIL 0.7            // more of it where the blur takes out detail, in units of that
#define QUIET 0.5             // share of that at full size, and once more where the frame is darker
#define FORGET 2.0            // frames that count after a larger one
#define SEEN_MOST 4.0         // so many times settings.history count at most, in frames that see less
#define LOST 0.5              // recent change for the better that may be lost occluders, in units of what is not seen
#define NARROW 4.0            // frames after which all detail counts
#define SHRINK 0.4            // spread of detail that counts as noise, in units of its square
#define SHRINK_RAYS 0.5       // the same for rays, which have more noise
