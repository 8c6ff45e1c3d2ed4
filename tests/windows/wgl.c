/* SPDX-License-Identifier: MIT
 *
 * windows_test FILE FOLDER: an effect in an OpenGL 3.3 core context of WGL. Its pictures are compared with those in
 * FILE, which another system wrote. FOLDER, an empty one, keeps linked programs: a run without files fills it, a run
 * with damaged ones replaces them, and the run after that compiles nothing.
 */
#include "gl.h"
#include "pictures.h"

#include <stdio.h>
#include <string.h>
#include <windows.h>

/* wglext.h */
typedef HGLRC(WINAPI *create_context_fn)(HDC device, HGLRC share, const int *attributes);
enum { MAJOR_VERSION = 0x2091, MINOR_VERSION = 0x2092, PROFILE_MASK = 0x9126, CORE_PROFILE = 1 };

static int compiles; /* of shaders, since the last run */
static PFNGLCOMPILESHADERPROC real_compile;

static void APIENTRY compile(GLuint shader)
{
    ++compiles;
    real_compile(shader);
}

/* wglGetProcAddress gives the functions after OpenGL 1.1, and small numbers for none; opengl32.dll exports the rest. */
static void *load(const char *name, void *user)
{
    PROC function = wglGetProcAddress(name);
    void *address = NULL;
    (void)user;
    if ((intptr_t)function >= -1 && (intptr_t)function <= 3)
        function = GetProcAddress(GetModuleHandleA("opengl32.dll"), name);
    if (function && strcmp(name, "glCompileShader") == 0) {
        memcpy(&real_compile, &function, sizeof real_compile);
        memcpy(&address, &(PFNGLCOMPILESHADERPROC[1]){compile}, sizeof address);
        return address;
    }
    memcpy(&address, &function, sizeof address);
    return address;
}

static HDC make_window(void)
{
    const HINSTANCE instance = GetModuleHandleA(NULL);
    const WNDCLASSA kind = {
        .style = CS_OWNDC, .lpfnWndProc = DefWindowProcA, .hInstance = instance, .lpszClassName = "glssao"};
    RegisterClassA(&kind);
    const HWND window =
        CreateWindowA("glssao", "glssao", WS_OVERLAPPEDWINDOW, 0, 0, 64, 64, NULL, NULL, instance, NULL);
    const HDC device = window ? GetDC(window) : NULL;
    const PIXELFORMATDESCRIPTOR format = {.nSize = sizeof format,
                                          .nVersion = 1,
                                          .dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER,
                                          .iPixelType = PFD_TYPE_RGBA,
                                          .cColorBits = 32,
                                          .cDepthBits = 24};
    if (!device || !SetPixelFormat(device, ChoosePixelFormat(device, &format), &format))
        return NULL;
    return device;
}

/* A core context is asked for by a function that only a context can give. */
static bool make_context(void)
{
    const HDC device = make_window();
    const HGLRC old = device ? wglCreateContext(device) : NULL;
    if (!old || !wglMakeCurrent(device, old))
        return false;
    const PROC function = wglGetProcAddress("wglCreateContextAttribsARB");
    create_context_fn create;
    memcpy(&create, &function, sizeof create);
    const int attributes[] = {MAJOR_VERSION, 3, MINOR_VERSION, 3, PROFILE_MASK, CORE_PROFILE, 0};
    const HGLRC context = create ? create(device, NULL, attributes) : NULL;
    if (!context || !wglMakeCurrent(device, context))
        return false;
    wglDeleteContext(old);
    return true;
}

/* Changes the last byte of each file of the folder; returns how many there are. */
static int damage(const char *folder)
{
    char path[MAX_PATH];
    WIN32_FIND_DATAA found;
    int count = 0;
    snprintf(path, sizeof path, "%s\\*.bin", folder);
    const HANDLE search = FindFirstFileA(path, &found);
    if (search == INVALID_HANDLE_VALUE)
        return 0;
    do {
        snprintf(path, sizeof path, "%s\\%s", folder, found.cFileName);
        FILE *const file = fopen(path, "r+b");
        if (!file || fseek(file, -1, SEEK_END) != 0)
            return -1;
        const int byte = fgetc(file);
        fseek(file, -1, SEEK_END);
        fputc(byte ^ 0x5A, file);
        fclose(file);
        ++count;
    } while (FindNextFileA(search, &found));
    FindClose(search);
    return count;
}

static int fail(const char *what)
{
    fprintf(stderr, "windows_test: %s\n", what);
    return 1;
}

int main(int argc, char **argv)
{
    char error[256];
    if (argc != 3)
        return fail("usage: windows_test FILE FOLDER");
    if (!make_context())
        return fail("no OpenGL 3.3 core context");
    if (!gl_load(load, NULL, error, sizeof error))
        return fail(error);
    printf("WGL: %s, OpenGL %s\n", (const char *)gl.GetString(GL_RENDERER), (const char *)gl.GetString(GL_VERSION));
    GLint mask = 0;
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &mask);
    if (!(mask & GL_CONTEXT_CORE_PROFILE_BIT))
        return fail("the context is not of the core profile");

    GLint formats = 0;
    gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    int counts[4], files = 0;
    for (int i = 0; i < 4; ++i) { /* no files, good files, damaged files, good files again */
        const pictures_host host = {.load = load, .cache = argv[2]};
        if (i == 2)
            files = damage(argv[2]);
        compiles = 0;
        if (!pictures_check(&host, argv[1], true))
            return 1;
        counts[i] = compiles;
    }
    printf("shaders compiled: %d, %d, %d, %d; %d files\n", counts[0], counts[1], counts[2], counts[3], files);
    if (formats == 0) {
        printf("no program binaries here: the cache was not tested\n");
        return 0;
    }
    if (counts[0] == 0 || files <= 0 || counts[1] != 0)
        return fail("the first run did not fill the cache");
    if (counts[2] != counts[0])
        return fail("damaged files were loaded");
    if (counts[3] != 0)
        return fail("damaged files were not replaced");
    return 0;
}
