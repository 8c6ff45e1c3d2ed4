/* SPDX-License-Identifier: MIT
 *
 * Ambient light on occluded surfaces as the demo computes it (examples/scene/shaders/bent.glsl and main.frag), in
 * double precision.
 */
#pragma once

/* How much more of the light that is linear in direction arrives than from a whole hemisphere, if what is open is a
 * cone. */
double open_light_linear(double accessibility);
/* Irradiance / pi of environment.h along a unit direction in the sky's axes; linear 1: from a whole hemisphere. */
void open_light_matte(const float irradiance[9][3], const double direction[3], double linear, double out[3]);
/* The share of the reflection's cone about `mirror` that lies in the open cone about `bent`, of that above the surface.
 */
double open_light_cone(const double bent[3], double accessibility, const double normal[3], const double mirror[3],
                       double roughness);
/* The same from accessibility alone (Lagarde and de Rousiers 2014, listing 26). */
double open_light_lobe(double cos_eye, double accessibility, double roughness);
