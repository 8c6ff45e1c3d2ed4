/* SPDX-License-Identifier: MIT
 *
 * Shows ray-traced accessibility, and how far the current result is from it.
 */
#include "error_color.h"
#include "viewer.h"

#include <GLFW/glfw3.h>

#include <math.h>
#include <stdlib.h>

bool viewer_shows_truth(const viewer *v)
{
    return v->shown == SHOWN_TRUTH || v->shown == SHOWN_DIFFERENCE;
}

void viewer_drop_truth(viewer *v)
{
    ray_worker_stop(v->truth);
    v->truth = NULL;
    v->truth_rounds = v->truth_shown_rounds = 0;
    v->truth_rmse = -1;
    free(v->truth_mean);
    v->truth_mean = NULL;
}

static bool start(viewer *v)
{
    v->truth_mean = malloc((size_t)v->width * (size_t)v->height * sizeof *v->truth_mean);
    v->truth = v->truth_mean ? ray_worker_start(v->scene, glfwPostEmptyEvent) : NULL;
    if (!v->truth) {
        viewer_say(v, true, "ray tracing could not start: out of memory or threads");
        return false;
    }
    const float radius = v->settings.radius_in_pixels ? camera_suggest_radius(v->scene) : v->settings.radius;
    ray_worker_ask(
        v->truth, &(ray_request){
                      .view = v->view, .step = 1, .radius = radius, .rays = TRUTH_ROUND_RAYS, .seed = v->options.seed});
    return true;
}

/* Paints the truth in grey, or the error in colours. */
static void paint(viewer *v, const float *ao, uint8_t (*out)[4])
{
    double sum = 0;
    size_t seen = 0;
    for (size_t i = 0; i < (size_t)v->width * (size_t)v->height; i++) {
        const float traced = v->settings.power == 1 ? v->truth_mean[i] : powf(v->truth_mean[i], v->settings.power);
        const double error = (double)ao[i] - (double)traced;
        const bool sky = v->truth_mean[i] == 1 && ao[i] == 1;
        double rgb[3] = {(double)traced, (double)traced, (double)traced};
        sum += sky ? 0 : error * error;
        seen += !sky;
        if (v->shown == SHOWN_DIFFERENCE)
            error_color(error, VIEWER_ERROR_RANGE, rgb);
        for (int k = 0; k < 3; k++)
            out[i][k] = (uint8_t)lround(255 * fmin(fmax(rgb[k], 0), 1));
        out[i][3] = 255;
    }
    v->truth_rmse = seen ? sqrt(sum / (double)seen) : 0;
}

void viewer_draw_truth(viewer *v)
{
    if (!v->truth && !start(v)) {
        v->shown = SHOWN_PICTURE;
        return;
    }
    v->truth_rounds = ray_worker_read(v->truth, NULL, FAULT(v->error));
    if (v->truth_rounds < 0) {
        viewer_say(v, true, "ray tracing failed: %s", v->error);
        viewer_drop_truth(v);
        v->shown = SHOWN_PICTURE;
        return;
    }
    const size_t count = (size_t)v->width * (size_t)v->height;
    float *ao = pipeline_read_ao(&v->pipeline, PIXELS_FLOAT);
    uint8_t(*pixels)[4] = calloc(count, sizeof *pixels);
    if (ao && pixels && v->truth_rounds > 0) {
        ray_worker_read(v->truth, v->truth_mean, FAULT(v->error));
        paint(v, ao, pixels);
    }
    if (ao && pixels) { /* black until the first round is done */
        gl.BindTexture(GL_TEXTURE_2D, v->map);
        gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, v->width, v->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
        gl.BindTexture(GL_TEXTURE_2D, 0);
    }
    v->truth_shown_rounds = v->truth_rounds;
    free(ao);
    free(pixels);
}
