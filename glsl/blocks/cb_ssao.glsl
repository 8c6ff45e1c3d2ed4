// SPDX-License-Identifier: MIT
// Members of the uniform block cbSsao (std140). Both compilers read this file: GLSL inside the block, C to check
// glssao_constants against it.
mat4 gProj;                 // clip from view
mat4 gInvProj;              // view from clip
mat4 gProjTex;              // uv from view, before the division by w
vec4 gOffsetVectors[14];    // 8 cube corners, 6 face centres, lengths 0.25..1
vec4 gBlurWeights[3];       // 11 weights that sum to 1, then 0
vec2 gInvRenderTargetSize;  // a texel of the ambient map, in uv
float gOcclusionRadius;     // scene units; in pixels and perspective (RADIUS_GROWS) per unit of view distance
float gOcclusionFadeStart;  // scene units of view distance
float gOcclusionFadeEnd;    // scene units of view distance
float gSurfaceEpsilon;      // scene units of view distance
