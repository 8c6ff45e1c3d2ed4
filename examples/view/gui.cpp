// SPDX-License-Identifier: MIT
#include "gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace
{

float pixel_scale = 1;
bool keys_to_panel = false;

// ImGui wants words ended by zeros, and one more zero.
std::string zero_separated(const char *names)
{
    std::string list = names;
    for (char &c : list)
        if (c == '|')
            c = '\0';
    list.push_back('\0');
    return list;
}

} // namespace

extern "C" {

void gui_start(GLFWwindow *window, float scale)
{
    pixel_scale = scale;
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr;
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImGui::GetStyle().WindowRounding = 0;
    ImFontConfig font;
    font.SizePixels = std::floor(13 * scale);
    io.Fonts->AddFontDefault(&font);
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330");
}

void gui_stop(void)
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void gui_begin_frame(void)
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void gui_end_frame(void)
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool gui_wants_mouse(void)
{
    return ImGui::GetIO().WantCaptureMouse;
}

bool gui_wants_keyboard(void)
{
    return ImGui::GetIO().WantTextInput || keys_to_panel;
}

void gui_leave(void)
{
    keys_to_panel = false;
    ImGui::GetIO().ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
    ImGui::SetWindowFocus(nullptr);
}

float gui_panel_width(float scale)
{
    return std::floor(390 * scale);
}

void gui_begin_panel(const char *title, bool focus)
{
    const float width = gui_panel_width(pixel_scale);
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSize(ImVec2(width, ImGui::GetIO().DisplaySize.y));
    ImGui::SetNextWindowBgAlpha(0.9f);
    if (focus) {
        ImGui::SetNextWindowFocus();
        keys_to_panel = true;
        ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    }
    ImGui::Begin(title, nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushItemWidth(ImGui::GetFontSize() * 11);
}

void gui_end_panel(void)
{
    ImGui::PopItemWidth();
    ImGui::End();
}

bool gui_begin_dialog(const char *title, bool *open)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    if (!*open)
        return false;
    ImGui::SetNextWindowPos(ImVec2(size.x / 2, size.y / 2), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
    if (!ImGui::Begin(title, open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
        ImGui::End();
        return false;
    }
    return true;
}

void gui_end_dialog(void)
{
    ImGui::End();
}

bool gui_section(const char *title, bool open_at_first)
{
    return ImGui::CollapsingHeader(title, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void gui_text(const char *text)
{
    ImGui::TextUnformatted(text);
}

void gui_text_wrapped(const char *text)
{
    ImGui::TextWrapped("%s", text);
}

void gui_same_line(void)
{
    ImGui::SameLine();
}

bool gui_button(const char *label)
{
    return ImGui::Button(label);
}

bool gui_reset(const char *label, bool differs)
{
    ImGui::SameLine();
    ImGui::PushID(label);
    ImGui::BeginDisabled(!differs);
    const bool pressed = ImGui::SmallButton("reset");
    ImGui::EndDisabled();
    ImGui::PopID();
    return pressed && differs;
}

void gui_tip(const char *text)
{
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", text);
}

bool gui_check(const char *label, bool *value)
{
    return ImGui::Checkbox(label, value);
}

bool gui_choice(const char *label, int *value, const char *names)
{
    return ImGui::Combo(label, value, zero_separated(names).c_str());
}

bool gui_slider(const char *label, const char *unit, float *value, float low, float high, bool logarithmic,
                float standard)
{
    char text[128];
    std::snprintf(text, sizeof text, "%s%s%s", label, unit[0] ? ", " : "", unit);
    bool changed = ImGui::SliderFloat(text, value, low, high, "%.4g",
                                      ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
    if (gui_reset(label, *value != standard)) {
        *value = standard;
        changed = true;
    }
    return changed;
}

bool gui_slider_whole(const char *label, const char *unit, int *value, int low, int high, int standard)
{
    char text[128];
    std::snprintf(text, sizeof text, "%s%s%s", label, unit[0] ? ", " : "", unit);
    bool changed = ImGui::SliderInt(text, value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
    if (gui_reset(label, *value != standard)) {
        *value = standard;
        changed = true;
    }
    return changed;
}

bool gui_input(const char *label, char *text, size_t size, bool focus)
{
    if (focus)
        ImGui::SetKeyboardFocusHere();
    return ImGui::InputText(label, text, size, ImGuiInputTextFlags_EnterReturnsTrue);
}

void gui_graph(const char *label, const float *values, int count, int first, float high)
{
    ImGui::PlotLines(label, values, count, first, nullptr, 0, high, ImVec2(0, ImGui::GetFontSize() * 2));
}

void gui_progress(float share, const char *text)
{
    ImGui::ProgressBar(share, ImVec2(-1, 0), text);
}

bool gui_begin_table(const char *name)
{
    if (!ImGui::BeginTable(name, 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit))
        return false;
    ImGui::TableSetupColumn("name");
    ImGui::TableSetupColumn("value");
    ImGui::TableSetupColumn("why", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

void gui_table_row(const char *name, bool runs, const char *value, const char *reason)
{
    const ImVec4 color = ImGui::GetStyleColorVec4(runs ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value);
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", reason);
    ImGui::PopStyleColor();
}

void gui_end_table(void)
{
    ImGui::EndTable();
}

void gui_line(float x0, float y0, float x1, float y1)
{
    ImDrawList *list = ImGui::GetBackgroundDrawList();
    list->AddLine(ImVec2(x0, y0), ImVec2(x1, y1), IM_COL32(0, 0, 0, 160), 3 * pixel_scale);
    list->AddLine(ImVec2(x0, y0), ImVec2(x1, y1), IM_COL32(255, 255, 255, 255), pixel_scale);
}

void gui_label(float x, float y, const char *text)
{
    ImDrawList *list = ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::CalcTextSize(text);
    list->AddRectFilled(ImVec2(x - 4, y - 2), ImVec2(x + size.x + 4, y + size.y + 2), IM_COL32(0, 0, 0, 160));
    list->AddText(ImVec2(x, y), IM_COL32(255, 255, 255, 255), text);
}

void gui_notice(const char *text, bool is_error)
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float wrap = display.x * 0.9f, margin = 6 * pixel_scale;
    const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, wrap);
    const ImVec2 at((display.x - size.x) / 2, display.y - size.y - 3 * margin);
    ImDrawList *list = ImGui::GetForegroundDrawList();
    list->AddRectFilled(ImVec2(at.x - margin, at.y - margin), ImVec2(at.x + size.x + margin, at.y + size.y + margin),
                        is_error ? IM_COL32(160, 20, 20, 255) : IM_COL32(30, 30, 30, 220), margin);
    list->AddText(nullptr, 0, at, IM_COL32(255, 255, 255, 255), text, nullptr, wrap);
}

} // extern "C"
