/* SPDX-License-Identifier: MIT
 *
 * A legacy host: fixed-function drawing in a compatibility context. Comments with "glssao" mark what adds ambient
 * occlusion.
 *   dropin-legacy [--frames N] [--picture FILE.ppm] [--no-ao] [--samples N] [--egl]
 */
#include "support.h"

#include <cglm/cglm.h>

/* glssao */
#include <glssao/glssao.h>
/* end */

static void draw_box(float x, float y, float z, float half_x, float half_y, float half_z)
{
    static const float sides[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    glBegin(GL_QUADS);
    for (int face = 0; face < 6; ++face) {
        const float *n = sides[face];
        int axis = face / 2;
        glNormal3fv(n);
        for (int k = 0; k < 4; ++k) {
            float p[3] = {n[0], n[1], n[2]};
            p[(axis + 1) % 3] = corners[k][0];
            p[(axis + 2) % 3] = corners[k][1];
            glVertex3f(x + half_x * p[0], y + half_y * p[1], z + half_z * p[2]);
        }
    }
    glEnd();
}

static void draw_scene(int width, int height)
{
    mat4 view, projection;
    glm_perspective(0.8f, (float)width / (float)height, 0.1f, 50.0f, projection);
    glm_lookat((vec3){2.2f, 2.4f, 3.6f}, (vec3){0.0f, 0.4f, 0.0f}, (vec3){0.0f, 1.0f, 0.0f}, view);
    glViewport(0, 0, width, height);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(projection[0]);
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixf(view[0]);
    glClearColor(0.3f, 0.4f, 0.6f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_COLOR_MATERIAL);
    glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){0.36f, 0.8f, 0.48f, 0.0f});
    glLightfv(GL_LIGHT0, GL_DIFFUSE, (const float[]){0.4f, 0.4f, 0.4f, 1.0f});
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (const float[]){0.6f, 0.6f, 0.6f, 1.0f});
    glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
    glColor3f(0.8f, 0.8f, 0.8f);
    draw_box(0.0f, -0.1f, 0.0f, 4.0f, 0.1f, 4.0f);
    glColor3f(0.9f, 0.6f, 0.4f);
    draw_box(-0.8f, 0.6f, 0.0f, 0.6f, 0.6f, 0.6f);
    glColor3f(0.5f, 0.7f, 0.9f);
    draw_box(0.5f, 0.4f, 0.3f, 0.4f, 0.4f, 0.4f);
    glColor3f(0.7f, 0.8f, 0.6f);
    draw_box(0.3f, 0.9f, -1.2f, 0.9f, 0.9f, 0.3f);
}

int main(int argc, char **argv)
{
    dropin_options o = dropin_read_options(argc, argv);
    GLFWwindow *window = dropin_open_window("glssao dropin-legacy", &o);
    int width = 640, height = 480;

    /* glssao */
    glssao_effect *effect = NULL;
    glssao_config config = {.get_proc = glfwGetProcAddress, .log = glssao_log_to_stderr, .width = 640, .height = 480};
    if (glssao_create(&config, &effect) != GLSSAO_OK)
        return 1;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 0.5f;
    /* end */

    while (!o.ended && !glfwWindowShouldClose(window)) {
        dropin_take_size(window, &width, &height);
        draw_scene(width, height);

        if (o.with_ao) {
            /* glssao, snippet: legacy frame */
            glssao_frame frame = {0};
            glGetFloatv(GL_PROJECTION_MATRIX, frame.projection);
            if (glssao_compute_framebuffer(effect, 0, &frame, &settings) == GLSSAO_OK)
                glssao_apply(effect, 0);
            /* end */
        }

        dropin_show(window, &o, width, height);
    }
    /* glssao */
    glssao_destroy(effect);
    /* end */
    glfwTerminate();
    return o.failed;
}
