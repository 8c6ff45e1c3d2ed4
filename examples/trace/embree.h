/* SPDX-License-Identifier: MIT
 *
 * Hides the differences between Embree 3 and 4: the header, the per-query context, and the two queries. Embree 4 takes
 * flags and context in an arguments struct. Filter functions set on a geometry work in both.
 */
#pragma once

#if GLSSAO_HAS_EMBREE >= 4
#include <embree4/rtcore.h>
typedef struct RTCRayQueryContext embree_context;
#else
#include <embree3/rtcore.h>
typedef struct RTCIntersectContext embree_context;
#endif

static inline void embree_init_context(embree_context *context)
{
#if GLSSAO_HAS_EMBREE >= 4
    rtcInitRayQueryContext(context);
#else
    rtcInitIntersectContext(context);
#endif
}

/* Of hit number i among the n that a filter function gets: Embree documents them as arrays of n in the order of
 * RTCHit's members, but has accessors for C++ alone. */
enum { EMBREE_HIT_PRIMITIVE = 5, EMBREE_HIT_GEOMETRY = 6, EMBREE_HIT_INSTANCE = 7 };

static inline unsigned embree_hit_number(const struct RTCHitN *hits, unsigned n, unsigned i, unsigned member)
{
    return ((const unsigned *)(const void *)hits)[member * n + i];
}

static inline void embree_hit_uv(const struct RTCHitN *hits, unsigned n, unsigned i, double out[2])
{
    const float *members = (const float *)(const void *)hits;
    out[0] = (double)members[3 * n + i];
    out[1] = (double)members[4 * n + i];
}

/* The nearest hit. */
static inline void embree_intersect(RTCScene scene, embree_context *context, struct RTCRayHit *ray)
{
#if GLSSAO_HAS_EMBREE >= 4
    struct RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = context;
    rtcIntersect1(scene, ray, &arguments);
#else
    rtcIntersect1(scene, context, ray);
#endif
}

/* Any hit of 16 rays, those with valid[i] = -1; tfar becomes -infinity where there is one. */
static inline void embree_occluded(RTCScene scene, embree_context *context, const int valid[16], struct RTCRay16 *rays)
{
#if GLSSAO_HAS_EMBREE >= 4
    struct RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = context;
    rtcOccluded16(valid, scene, rays, &arguments);
#else
    rtcOccluded16(valid, scene, context, rays);
#endif
}
