/* SPDX-License-Identifier: MIT
 *
 * The glTF loader, fed with any bytes: it gives a valid scene, or one line that names the file and a fault. The entry
 * point is libFuzzer's; replay.c calls it too.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "scene_validity.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static char folder[] = "/tmp/glssao-fuzz-XXXXXX";
static char path[64];

static void remove_folder(void)
{
    unlink(path);
    rmdir(folder);
}

/* The input lies alone in a folder of its own, so that no file it names is there. */
static void prepare(void)
{
    if (*path)
        return;
    if (!mkdtemp(folder))
        abort();
    snprintf(path, sizeof path, "%s/scene.gltf", folder);
    atexit(remove_folder);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    prepare();
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file) != 0)
        abort();
    char error[1024] = "";
    const scene_load_options little = {.memory_bytes = 64 << 20}; /* so that no run takes long */
    scene *s = scene_load_with(path, &little, FAULT(error));
    const char *flaw = NULL;
    if (s)
        flaw = scene_find_flaw(s);
    else if (strncmp(error, path, strlen(path)) != 0 || strlen(error) < strlen(path) + 3)
        flaw = "the error does not name the file and a fault";
    else if (strpbrk(error, "\r\n"))
        flaw = "the error has more than one line";
    if (flaw) {
        fprintf(stderr, "%s (%s)\n", flaw, error);
        abort();
    }
    scene_destroy(s);
    return 0;
}
