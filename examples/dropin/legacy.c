/* SPDX-License-Identifier: MIT
 *
 * A program of the old kind: fixed-function drawing straight into the window, multisampled if asked. Ambient
 * occlusion is added to it between "glssao" and "end" marks; window_depth.h fetches the window's depth.
 *   dropin-legacy [--frames N] [--picture FILE.ppm] [--no-ao] [--samples N] [--egl]
 */
#include <GL/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cglm/cglm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* snippet: legacy loader */
#include "window_depth.h" /* glssao */
#include <glssao/glssao.h>

static void *find_function(const char *name, void *user)
{
    (void)user;
    GLFWglproc function = glfwGetProcAddress(name);
    void *address;
    memcpy(&address, &function, sizeof address);
    return address;
} /* end */
/* end of snippet */

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

static bool save_picture(const char *path, int width, int height)
{
    size_t row = (size_t)width * 3;
    unsigned char *rgb = malloc(row * (size_t)height);
    FILE *file = fopen(path, "wb");
    bool ok = rgb && file;
    if (ok) {
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
        fprintf(file, "P6 %d %d 255\n", width, height);
        for (int y = height; ok && y-- > 0;)
            ok = fwrite(rgb + row * (size_t)y, row, 1, file) == 1;
    }
    free(rgb);
    return file && fclose(file) == 0 && ok;
}

int main(int argc, char **argv)
{
    int frames = -1, samples = 0, width = 640, height = 480;
    bool with_ao = true, egl = false, ok = true;
    const char *picture = NULL;
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--frames") == 0 && i + 1 < argc)
            frames = atoi(argv[++i]);
        else if (strcmp(argv[i], "--samples") == 0 && i + 1 < argc)
            samples = atoi(argv[++i]);
        else if (strcmp(argv[i], "--picture") == 0 && i + 1 < argc)
            picture = argv[++i];
        else if (strcmp(argv[i], "--no-ao") == 0)
            with_ao = false;
        else if (strcmp(argv[i], "--egl") == 0)
            egl = true;
    }
    if (!glfwInit())
        return 1;
    glfwWindowHint(GLFW_SAMPLES, samples);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, egl ? GLFW_EGL_CONTEXT_API : GLFW_NATIVE_CONTEXT_API);
    GLFWwindow *window = glfwCreateWindow(width, height, "glssao dropin-legacy", NULL, NULL);
    if (!window)
        return 1;
    glfwMakeContextCurrent(window);

    /* snippet: legacy create */
    glssao_effect *effect = NULL; /* glssao */
    glssao_config config = {.load = find_function, .log = glssao_log_to_stderr, .width = width, .height = height};
    window_depth *depth_copy = window_depth_create(find_function, NULL);
    if (!depth_copy || glssao_create(&config, &effect) != GLSSAO_OK)
        return 1;
    glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_HIGH);
    settings.radius = 0.5f; /* end */
    /* end of snippet */

    while (ok && frames != 0 && !glfwWindowShouldClose(window)) {
        int w, h;
        glfwGetFramebufferSize(window, &w, &h);
        if ((w != width || h != height) && w > 0 && h > 0) {
            width = w;
            height = h;
            glssao_resize(effect, width, height); /* glssao */ /* end */
        }
        draw_scene(width, height);

        /* snippet: legacy frame */
        if (with_ao) { /* glssao */
            const char *why;
            glssao_frame frame = {.depth_texture = window_depth_copy(depth_copy, 0, width, height, &why)};
            glGetFloatv(GL_PROJECTION_MATRIX, frame.projection);
            if (frame.depth_texture && glssao_compute(effect, &frame, &settings) == GLSSAO_OK)
                glssao_apply(effect, 0);
        } /* end */
        /* end of snippet */

        if (frames > 0 && --frames == 0 && picture)
            ok = save_picture(picture, width, height) && glGetError() == GL_NO_ERROR;
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
    window_depth_destroy(depth_copy); /* glssao */
    glssao_destroy(effect);           /* end */
    glfwTerminate();
    return ok ? 0 : 1;
}
