/* SPDX-License-Identifier: MIT
 *
 * Another project's renderer: Dear ImGui's OpenGL 3 back end, as Debian builds it, draws the same pixels before and
 * after every call that draws, and the effect gives the same map before and after it.
 */
#include <backends/imgui_impl_opengl3.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <imgui.h>
#include <set>
#include <vector>

extern "C" { /* after the C++ headers, which its own would include */
#include "fixture.h"
}

namespace
{

constexpr int W = 256, H = 192;
using picture = std::vector<float>;

/* Draws the demo window into the bound framebuffer, whose texture is `color`: the same frame each time. It binds and
 * sets nothing, so any state that the library left behind shows. */
picture draw_imgui(GLuint color)
{
    const float clear[4] = {0.2f, 0.3f, 0.4f, 1.0f};
    gl.ClearBufferfv(GL_COLOR, 0, clear);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    float *texels = fixture_read_texture(color, W, H, 4);
    picture result(texels, texels + 4 * W * H);
    free(texels);
    return result;
}

TEST_GL(imgui_draws_the_same_before_and_after)
{
    const fixture_target target = fixture_make_target(GL_RGBA8, W, H);
    const GLuint color = target.texture;
    gl.Viewport(0, 0, W, H);
    const glssao_frame room = fixture_room(PERSPECTIVE, W, H);
    glssao_frame frame = room;
    frame.normal_texture = 0;

    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = ImVec2(W, H);
    assert_true(ImGui_ImplOpenGL3_Init("#version 330"));
    for (int i = 0; i < 3; ++i) { /* windows settle within a few frames */
        ImGui_ImplOpenGL3_NewFrame();
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(ImVec2(8, 8));
        ImGui::SetNextWindowSize(ImVec2(W - 16, H - 16));
        ImGui::ShowDemoWindow();
        ImGui::Render();
    }
    const picture before = draw_imgui(color);
    assert_true(std::set<float>(before.begin(), before.end()).size() > 20); /* text and widgets, not a blank window */

    glssao_effect *effect = fixture_effect(f, W, H);
    assert_true(draw_imgui(color) == before);
    const glssao_technique techniques[] = {GLSSAO_CLASSIC, GLSSAO_HEMISPHERE, GLSSAO_HORIZON};
    for (const glssao_technique technique : techniques) {
        const glssao_settings settings = glssao_default_settings(technique, GLSSAO_MEDIUM);
        int width, height;
        float *map = fixture_compute(effect, &frame, &settings, &width, &height);
        assert_true(draw_imgui(color) == before);
        float *again = fixture_compute(effect, &frame, &settings, &width, &height);
        assert_memory_equal(map, again, size_t(width) * size_t(height) * sizeof *map);
        free(map);
        free(again);
    }
    assert_int_equal(glssao_apply(effect, target.framebuffer), GLSSAO_OK);
    assert_true(draw_imgui(color) == before);
    assert_int_equal(glssao_begin_normals(effect, frame.depth_texture), GLSSAO_OK);
    assert_int_equal(glssao_end_normals(effect), GLSSAO_OK);
    assert_true(draw_imgui(color) == before);
    assert_int_equal(glssao_resize(effect, W / 2, H / 2), GLSSAO_OK);
    assert_true(draw_imgui(color) == before);
    glssao_destroy(effect);
    assert_true(draw_imgui(color) == before);

    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
    fixture_delete_target(&target);
    fixture_delete_frame(&room);
}

} // namespace

TEST_MAIN(nullptr, fixture_setup, fixture_teardown)
