/* SPDX-License-Identifier: MIT */
#include "schedules.h"

enum { DEPTH_NAME = 1, NORMAL_NAME, BACK_NAME, SECOND_NAME, MOTION_NAME, RAYS_NAME };

glssao__request schedules_request(glssao_frame *frame, glssao_settings *settings, int width, int height)
{
    *frame = (glssao_frame){.depth_texture = DEPTH_NAME, .normal_texture = NORMAL_NAME};
    frame->projection[0] = frame->projection[5] = 1.0f;
    frame->projection[10] = frame->projection[11] = -1.0f;
    frame->projection[14] = -0.2f;
    return (glssao__request){
        .frame = frame,
        .settings = settings,
        .size = {width, height},
        .can = {.compute = true, .path = GLSSAO_PATH_AUTO, .max_size = 16384, .max_point_size = 256.0f}};
}

typedef struct visitor {
    void (*visit)(const glssao__request *request, const glssao__schedule *schedule, void *user);
    void *user;
    int count;
} visitor;

static void visit(visitor *v, const glssao__request *q)
{
    glssao__schedule schedule;
    glssao__schedule_make(&schedule, q);
    v->visit(q, &schedule, v->user);
    v->count += 1;
}

/* How the host stores its maps. */
static void visit_inputs(visitor *v, glssao__request *q, glssao_frame *frame)
{
    for (int depth = 0; depth <= GLSSAO_DEPTH_LOGARITHMIC; ++depth)
        for (int normal = -1; normal <= GLSSAO_NORMAL_OCTAHEDRAL; ++normal)
            for (int variant = 0; variant < 16; ++variant) { /* layers, orthographic, multisample, turned and oblique */
                frame->depth_kind = (glssao_depth)depth;
                frame->normal_texture = normal >= 0 || depth == GLSSAO_DEPTH_NORMAL_ALPHA ? NORMAL_NAME : 0;
                frame->normal_kind = (glssao_normal)(normal > 0 ? normal : 0);
                frame->back_texture = variant & 1 ? BACK_NAME : 0;
                frame->second_texture = variant & 1 ? SECOND_NAME : 0;
                q->is_orthographic = variant & 2;
                frame->multisample = variant & 4;
                q->is_turned = q->is_oblique = variant & 8;
                visit(v, q);
            }
}

/* Without bent normals and with them, on a GPU by compute and by fragment shaders, and on a software rasteriser with
 * tiles. */
static void visit_capabilities(visitor *v, glssao__request *q, glssao_frame *frame, glssao_settings *settings)
{
    const bool can_bend = settings->technique == GLSSAO_HORIZON && frame->rays_texture == 0 && settings->history == 0;
    const int both = can_bend ? 2 : 1;
    for (int bent = 0; bent < both; ++bent)
        for (int can = 0; can < 3; ++can) {
            settings->bent_normals = bent;
            q->can.path = can == 0 ? GLSSAO_PATH_COMPUTE : GLSSAO_PATH_FRAGMENT;
            q->can.is_software = can == 2;
            visit_inputs(v, q, frame);
        }
    settings->bent_normals = false;
}

int schedules_visit(void (*function)(const glssao__request *request, const glssao__schedule *schedule, void *user),
                    void *user)
{
    static const int samples[] = {12, 16, 24, 32, 48, 64};
    visitor v = {.visit = function, .user = user};
    glssao_frame frame;
    glssao_settings settings;
    glssao__request q = schedules_request(&frame, &settings, 1280, 720);
    for (int technique = 0; technique <= GLSSAO_RAYS; ++technique)
        for (int blur = 0; blur <= GLSSAO_BLUR_PLANAR; ++blur)
            for (int rounds = 0; rounds <= 4; ++rounds)
                for (int size = 0; size < 3; ++size) {
                    settings = glssao_default_settings((glssao_technique)technique, GLSSAO_HIGH);
                    settings.blur = (glssao_blur)blur;
                    settings.blur_rounds = rounds;
                    settings.half_resolution = size > 0;
                    settings.upsample = size > 1;
                    settings.no_angle_weight = rounds == 1;
                    frame.margin = rounds == 2 ? 16 : 0;
                    frame.rays_texture = technique == GLSSAO_RAYS || rounds == 3 ? RAYS_NAME : 0;
                    if (technique != GLSSAO_RAYS || blur == GLSSAO_BLUR_NONE || blur == GLSSAO_BLUR_PLANAR)
                        visit_capabilities(&v, &q, &frame, &settings);
                    frame.rays_texture = 0;
                    if (technique == GLSSAO_RAYS || rounds < 1 || rounds > 2) /* rays have no history */
                        continue;
                    settings.noise_index = 3;
                    settings.history = size < 2 ? 16 : 0;
                    frame.motion_texture = rounds == 1 ? MOTION_NAME : 0;
                    q.frames = rounds;
                    visit_capabilities(&v, &q, &frame, &settings);
                    frame.motion_texture = 0;
                    q.frames = 0;
                }
    frame.margin = 0;
    frame.rays_texture = 0;
    for (int i = 0; i < 6; ++i)
        for (int accumulates = 0; accumulates < 2; ++accumulates) {
            settings = glssao_default_settings(GLSSAO_HORIZON, i % 2 ? GLSSAO_HIGH : GLSSAO_ULTRA);
            settings.sample_count = samples[i];
            if (accumulates)
                settings = glssao__schedule_accumulated(&settings);
            q.estimates = accumulates ? 2 : 0;
            visit_capabilities(&v, &q, &frame, &settings);
        }
    return v.count;
}
