/* SPDX-License-Identifier: MIT
 *
 * glssao-state-share: what saving and restoring the host's GL state takes of a frame: the pair of calls alone, many
 * times over, beside glssao_compute and glssao_apply (which save and restore once each) with everything finished.
 *   glssao-state-share [WIDTH HEIGHT]
 */
#include "analytic.h"
#include "clock.h"
#include "effect.h"
#include "fixture.h"

enum { FRAMES = 30, PAIRS = 2000, ROUNDS = 5 };

static double frame_ms(glssao_effect *effect, const glssao_frame *frame, GLuint framebuffer)
{
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    const double start = clock_wall_ms();
    for (int i = 0; i < FRAMES; ++i) {
        if (glssao_compute(effect, frame, &settings) != GLSSAO_OK || glssao_apply(effect, framebuffer) != GLSSAO_OK)
            exit(1);
        gl.Finish();
    }
    return (clock_wall_ms() - start) / FRAMES;
}

static double pair_ms(const glssao_effect *effect)
{
    const glssao__state_need need = {.parts = STATE_DRAW | STATE_UNIFORMS, .units = 0x3F, .blocks = BLOCK_HEMISPHERE};
    const double start = clock_wall_ms();
    for (int i = 0; i < PAIRS; ++i) {
        glssao__state state;
        glssao__state_save(&effect->gl, &need, false, &state);
        glssao__state_restore(&effect->gl, &state);
    }
    gl.Finish();
    return (clock_wall_ms() - start) / PAIRS;
}

int main(int argc, char **argv)
{
    const int width = argc == 3 ? atoi(argv[1]) : 1280, height = argc == 3 ? atoi(argv[2]) : 720;
    void *state = NULL;
    if (width < 1 || height < 1 || fixture_setup(&state) != 0)
        return 2;
    const glssao_frame frame = fixture_room(PERSPECTIVE, width, height);
    const fixture_target target = fixture_make_target(GL_RGBA8, width, height);
    glssao_effect *effect = fixture_effect(state, width, height);
    frame_ms(effect, &frame, target.framebuffer); /* compiles */
    double least_frame = 1e9, least_pair = 1e9;
    for (int i = 0; i < ROUNDS; ++i) {
        const double frame_time = frame_ms(effect, &frame, target.framebuffer), pair_time = pair_ms(effect);
        least_frame = frame_time < least_frame ? frame_time : least_frame;
        least_pair = pair_time < least_pair ? pair_time : least_pair;
    }
    printf("%d x %d, horizon-high and apply: %.2f ms; saving and restoring twice: %.4f ms, %.3f %% (%s)\n", width,
           height, least_frame, 2.0 * least_pair, 200.0 * least_pair / least_frame,
           (const char *)gl.GetString(GL_RENDERER));
    glssao_destroy(effect);
    fixture_delete_target(&target);
    fixture_delete_frame(&frame);
    fixture_teardown(&state);
    return 0;
}
