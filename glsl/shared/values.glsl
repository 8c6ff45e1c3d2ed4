// SPDX-License-Identifier: MIT
// Values of the variant macros that are neither 0/1 nor a number of something. GLSL and C read this file.

// Farther than any surface: stands for sky and for depths that are not numbers. Its square still fits a float.
#define FAR_AWAY 1e15

// Stands for the accessibility of a pixel without rays, as any negative number does.
#define MISSING (-1.0)

// How the host stores normals.
#define NORMALS_SIGNED 0
#define NORMALS_UNSIGNED 1
#define NORMALS_OCTAHEDRAL 2
#define NORMALS_REBUILT 3 // octahedral, at the estimate's size: passes/normals.frag

// How the host stores depth.
#define DEPTH_WINDOW 0
#define DEPTH_DISTANCE 1
#define DEPTH_ALPHA 2 // view distance in the alpha of the normal map

// What an estimate or a blur writes.
#define OUTPUT_ACCESSIBILITY 0
#define OUTPUT_PAIRED 1 // shared/paired.glsl
#define OUTPUT_SUM 2    // linear accessibility, to be added to the sum of its replicate
#define OUTPUT_BENT 3   // accessibility, and into a second target the bent normal with accessibility

// The taps of blur.frag.
#define FILTER_GAUSSIAN 0
#define FILTER_BILATERAL 1
#define FILTER_BOX 2

// What decides how much occlusion counts.
#define STRENGTH_FULL 0
#define STRENGTH_UNIFORM 1
#define STRENGTH_TEXTURE 2 // and the uniform

// Formats of a picture that apply.frag can load and store.
#define IMAGE_RGBA8 1
#define IMAGE_RGBA16 2
#define IMAGE_RGBA16F 3
#define IMAGE_RGBA32F 4
#define IMAGE_RGB10_A2 5
#define IMAGE_R11F_G11F_B10F 6
