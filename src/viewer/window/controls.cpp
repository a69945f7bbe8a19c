#include "viewer/window/controls.h"

#include <algorithm>
#include <array>

#include <GLFW/glfw3.h>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr float kLookSpeed = 0.2f, kOrbitSpeed = 0.4f;  ///< degrees per pixel of mouse movement
constexpr float kTurn = 15.0f;                          ///< degrees per key press
constexpr float kGaze = 60.0f;                          ///< degrees per second while a key is down
constexpr float kWheel = 0.2f;                          ///< seconds of walking per wheel notch
constexpr float kKeyPress = 0.1f;  ///< minimum seconds of walking per key press
constexpr float kClick = 4.0f;     ///< mouse movement that starts a drag [pixels]
constexpr float kStop = 0.5f;      ///< exposure stops per key press
constexpr float kFarthest = 1e3f;  ///< maximum distance of a moved object, in strides

constexpr std::array kHelp = {
    KeyHelp{"W A S D", "walk"},
    KeyHelp{"E Q", "walk up, down"},
    KeyHelp{"arrows", "look around"},
    KeyHelp{"drag left", "look around; on the picked object: move it along the floor"},
    KeyHelp{"Shift drag left", "move it in the plane that faces you"},
    KeyHelp{"drag right", "orbit the picked object"},
    KeyHelp{"wheel", "walk forward or back"},
    KeyHelp{"click", "pick the object under the mouse"},
    KeyHelp{"R T", "rotate the picked object"},
    KeyHelp{"Delete", "delete it from the scene"},
    KeyHelp{"Esc", "unpick"},
    KeyHelp{"M", "next mode: light, lux, lumels, links, error"},
    KeyHelp{"L", "light of links, or of the last solve"},
    KeyHelp{"+ -", "more, less exposure"},
    KeyHelp{"X", "automatic exposure on, off"},
    KeyHelp{"Space", "play or pause the animation"},
    KeyHelp{"N", "solve again, with the options of the panel"},
    KeyHelp{"P", "write picture-N.png"},
    KeyHelp{"Ctrl S", "save as a bake"},
    KeyHelp{"Tab", "panel on, off"},
    KeyHelp{"H F1", "this help on, off"},
    KeyHelp{"Ctrl Q", "close"},
};

glm::vec2 mouse_place()
{
    const ImVec2 place = ImGui::GetIO().MousePos;
    return {place.x, place.y};
}

Ray ray_at(const ViewSession& session, const UiState& desk, const glm::vec2& mouse)
{
    return ray_through(session.camera().view(), mouse / glm::vec2(desk.coarse * desk.pixels()));
}

void next_mode(ViewSession& session)
{
    session.set_mode(ViewMode((int(session.mode()) + 1) % int(kViewModes.size())));
}

/// Walking keys: forward, right, up.
struct WalkKey {
    int key;
    glm::vec3 steps;
};
constexpr std::array kWalk = {
    WalkKey{GLFW_KEY_W, {1.0f, 0.0f, 0.0f}}, WalkKey{GLFW_KEY_S, {-1.0f, 0.0f, 0.0f}},
    WalkKey{GLFW_KEY_D, {0.0f, 1.0f, 0.0f}}, WalkKey{GLFW_KEY_A, {0.0f, -1.0f, 0.0f}},
    WalkKey{GLFW_KEY_E, {0.0f, 0.0f, 1.0f}}, WalkKey{GLFW_KEY_Q, {0.0f, 0.0f, -1.0f}},
};

/// Left and up.
struct GazeKey {
    int key;
    glm::vec2 turn;
};
constexpr std::array kGazes = {
    GazeKey{GLFW_KEY_LEFT, {1.0f, 0.0f}},
    GazeKey{GLFW_KEY_RIGHT, {-1.0f, 0.0f}},
    GazeKey{GLFW_KEY_UP, {0.0f, 1.0f}},
    GazeKey{GLFW_KEY_DOWN, {0.0f, -1.0f}},
};

/// Time that a key was down in the last frame [s]; a press counts for at least kKeyPress, however
/// short the frame.
float time_of(int key, const Screen& screen, const UiState& desk)
{
    const std::vector<KeyPress>& pressed = screen.pressed();
    const bool touched = std::any_of(pressed.begin(), pressed.end(), [&](const KeyPress& one) {
        return one.key == key && !one.control && !one.again;
    });
    const float held = screen.holds(key) ? float(desk.passed) : 0.0f;
    return touched ? std::max(kKeyPress, held) : held;
}

void press_with_control(int key, UiState& desk, Screen& screen)
{
    if (key == GLFW_KEY_Q)
        screen.close();
    else if (key == GLFW_KEY_S)
        desk.save = true;
}

}  // namespace

std::span<const KeyHelp> key_help()
{
    return kHelp;
}

void Controls::act(ViewSession& session, UiState& desk, Screen& screen)
{
    if (!ImGui::GetIO().WantTextInput) {
        for (const KeyPress& key : screen.pressed())
            try {
                press(key, session, desk, screen);
            } catch (const Error& error) {
                desk.message = error.what();
            }
        hold(session, desk, screen);
    }
    try {
        mouse(session, desk);
    } catch (const Error& error) {
        desk.message = error.what();
    }
}

void Controls::press(const KeyPress& press, ViewSession& session, UiState& desk, Screen& screen)
{
    if (press.control)
        return press_with_control(press.key, desk, screen);
    desk.changed = true;
    switch (press.key) {
    case GLFW_KEY_R:
    case GLFW_KEY_T:
        return session.turn(glm::radians(press.key == GLFW_KEY_R ? kTurn : -kTurn));
    case GLFW_KEY_DELETE:
        return session.remove();
    case GLFW_KEY_ESCAPE:
        return session.unpick();
    case GLFW_KEY_M:
        return next_mode(session);
    case GLFW_KEY_L:
        return session.show_solved(!session.shows_solved());
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
        return session.step_exposure(kStop);
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
        return session.step_exposure(-kStop);
    case GLFW_KEY_X:
        return session.set_automatic_exposure(!session.has_automatic_exposure());
    case GLFW_KEY_SPACE:
        desk.playing = !desk.playing;
        break;
    case GLFW_KEY_N:
        desk.solve = true;
        break;
    case GLFW_KEY_P:
        desk.shoot = true;
        break;
    case GLFW_KEY_TAB:
        desk.panel = !desk.panel;
        break;
    case GLFW_KEY_H:
    case GLFW_KEY_F1:
        desk.help = !desk.help;
        break;
    default:
        break;
    }
}

void Controls::hold(ViewSession& session, UiState& desk, const Screen& screen)
{
    for (const WalkKey& walk : kWalk)
        if (const float time = time_of(walk.key, screen, desk); time > 0.0f) {
            session.camera().walk(desk.stride * time * walk.steps);
            desk.changed = true;
        }
    for (const GazeKey& gaze : kGazes)
        if (const float time = time_of(gaze.key, screen, desk); time > 0.0f) {
            const glm::vec2 angle = glm::radians(kGaze * time * gaze.turn);
            session.camera().gaze(angle.x, angle.y);
            desk.changed = true;
        }
}

void Controls::mouse(ViewSession& session, UiState& desk)
{
    const ImGuiIO& io = ImGui::GetIO();
    const bool is_over = !io.WantCaptureMouse && mouse_place().x < float(desk.area.x) &&
                         mouse_place().y < float(desk.area.y);
    if (is_over && io.MouseWheel != 0.0f) {
        ViewCamera& camera = session.camera();
        camera.set_eye(camera.eye() + io.MouseWheel * kWheel * desk.stride * camera.forward());
        desk.changed = true;
    }
    const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left),
               right = ImGui::IsMouseDown(ImGuiMouseButton_Right);
    if (drag_ != Drag::none) {
        drag(session, desk);
        if (!left && !right)
            drag_ = Drag::none;
        return;
    }
    if (is_over && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) {
        session.pick(desk.pixel_at(mouse_place()));
        desk.changed = true;
    } else if (is_over && (left || right)) {
        drag_ = begin_drag(session, desk);
    }
    if (is_over && session.mode() == ViewMode::links &&
        (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
        session.probe(desk.pixel_at(mouse_place()));
        desk.changed = true;
    }
}

/// The action of a mouse that has moved far enough since it was pressed.
Controls::Drag Controls::begin_drag(ViewSession& session, const UiState& desk)
{
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, kClick))
        return Drag::orbit;
    if (!ImGui::IsMouseDragging(ImGuiMouseButton_Left, kClick))
        return Drag::none;
    const ImVec2 began = ImGui::GetIO().MouseClickedPos[ImGuiMouseButton_Left];
    const auto under = session.seen_at(desk.pixel_at({began.x, began.y}));
    const auto& picked = session.picked();
    if (!under || !picked || !under->thing || under->thing != picked->thing)
        return Drag::look;
    grip_ = under->place;
    return Drag::thing;
}

void Controls::drag(ViewSession& session, UiState& desk)
{
    const ImVec2 way = ImGui::GetIO().MouseDelta;
    if (way.x == 0.0f && way.y == 0.0f)
        return;
    desk.changed = true;
    if (drag_ == Drag::thing)
        return move_thing(session, desk);
    const float step = glm::radians(drag_ == Drag::look ? kLookSpeed : kOrbitSpeed);
    if (drag_ == Drag::look)
        session.camera().gaze(step * way.x, step * way.y);
    else
        session.orbit(-step * way.x, step * way.y);
}

/// Moves the object to the mouse position in the plane of the grip.
void Controls::move_thing(ViewSession& session, const UiState& desk)
{
    const glm::vec3 up(0.0f, 1.0f, 0.0f), to = session.camera().forward();
    glm::vec3 normal = up;
    if (ImGui::GetIO().KeyShift)
        normal = glm::vec3(to.x, 0.0f, to.z);
    const Ray ray = ray_at(session, desk, mouse_place());
    const float along = glm::dot(normal, ray.direction);
    const float distance = along != 0.0f ? glm::dot(normal, grip_ - ray.origin) / along : -1.0f;
    if (!(distance > 0.0f && distance < kFarthest * desk.stride))
        return;
    const glm::vec3 now = ray.origin + distance * ray.direction;
    session.move(now - grip_);
    grip_ = now;
}

}  // namespace lumel
