// SPDX-License-Identifier: MIT
// Members of the uniform block cbFrame (std140): what cbSsao has no room for. Read by both compilers, as cb_ssao.glsl.
vec4 gDistanceFromDepth;    // numerator at depth 0 and at 1, denominator at depth 0 and at 1
vec4 gRayOrigin;            // view xy at view distance 0: uv * xy + zw
vec4 gRayDirection;         // view xy gained per unit of view distance: uv * xy + zw
float gSkyDepth;            // the window depth, or the least view distance, that means nothing was drawn
float gPower;               // accessibility is raised to this
float gBlurNormalThreshold; // cosine
float gBlurDepthThreshold;  // scene units of view distance
int gSampleCount;           // offset vectors or kernel samples in use
int gFactor;                // full-size texels per texel of the estimate: 1 or 2
vec2 gNoise;                // offset of the noise: of the angle and of the jitter, 0..1 (accumulation, and with VARIES 1)
vec4 gAccumulation;         // xy: 1 for the replicate that the estimate belongs to; zw: estimates in each
vec4 gProbe;                // pixels: lower left corner of what is probed, size of a cell
vec4 gDepthStep;            // what a step of the depth format comes to in view distance t: x + y t + z t^2
vec4 gLogDepth;             // logarithmic depth: x: log2(c far + 1), y: 1 / c
vec4 gTiles;                // x: side of a tile, pixels of the estimate; y: how far samples reach, in radii; z: sine of
                            // the angle that still is flat, 0: no plane counts; w: scene units of range that do not occlude
vec4 gPixel;                // xy: scene units that a texel of the distance map is wide, in perspective per unit of view distance; zw: 1 over it
vec2 gEstimateSize;         // of the ambient map, pixels
vec2 gFullTexel;            // a texel of the host's maps, in uv
float gTileRings;           // how far tiles are told from the nearest that needs an estimate
float gWindowSky;           // the window depth that means nothing was drawn (OBLIQUE)
vec2 gRoll;                 // cosine and sine of the turn of the passes' view space about the view axis (TURNED)
vec2 gFadeFar;              // x: view distance from which on nothing is occluded; y: the share lost per unit before it
vec2 gThickness;            // x: multiplies estimated thickness; y: start of the run that the point belongs to, steps
vec4 gTurn[3];              // xyz: rows of the matrix from stored normals to the view space of the passes (TURNED)
vec4 gOblique;              // what numerator (xy) and denominator (zw) of gDistanceFromDepth gain per uv (OBLIQUE)
vec2 gMapSize;              // of the distance map, pixels
vec2 gMapTexel;             // a texel of it, in uv
mat4 gLastView;             // the last frame's view space from this one's (history, as all below)
vec4 gLastRayOrigin;        // gRayOrigin and gRayDirection of the last frame
vec4 gLastRayDirection;
vec4 gLastRegion;           // pixels that the last frame's history covers: first and last column and row
vec2 gHistory;              // x: most frames of a mean; y: 1 where there is a history
vec2 gPick;                 // which texel of the block that a pixel of the estimate stands for: 0 or 1 (VARIES 1)
vec2 gRaysPick;             // which pixel of four a texel of the host's half-size rays belongs to: 0 or 1 (VARIES 1)
float gTurns;               // 1: another one than in the last frame, 0: the same
