#pragma once

#include <array>
#include <string>
#include <string_view>

namespace pointfront
{

/// The action of a key in the window of `view`.
enum class KeyAction
{
  None,
  Help,
  Facts,
  Pick,
  Measure,
  NextColour,
  LastColour,
  NextTechnique,
  LastTechnique,
  NextQuality,
  EyeDome,
  Larger,
  Smaller,
  Classes,
  Up,
  Down,
  Toggle,
  ShowAll,
  ViewIso,
  ViewTop,
  ViewFront,
  ViewBack,
  ViewLeft,
  ViewRight,
  Projection,
  Screenshot,
  SaveCamera,
  RestoreCamera,
  Escape,
  Quit
};

struct KeyBinding
{
  const char* key; ///< as it is shown, and the keysym of X but for what keyActionOf() knows
  KeyAction action;
  const char* what; ///< for people
};

/// All keys of the window, in the order of the help.
constexpr std::array<KeyBinding, 29> keyTable{ {
  { "?", KeyAction::Help, "this help" },
  { "f", KeyAction::Facts, "frame rate, points and error" },
  { "p", KeyAction::Pick, "what the store holds of the point under the mouse" },
  { "m", KeyAction::Measure, "measure from the point under the mouse to a second one" },
  { "c", KeyAction::NextColour, "colour by the next attribute" },
  { "C", KeyAction::LastColour, "... the one before" },
  { "t", KeyAction::NextTechnique, "draw by the next technique" },
  { "T", KeyAction::LastTechnique, "... the one before" },
  { "x", KeyAction::NextQuality, "draft, balanced, exact" },
  { "l", KeyAction::EyeDome, "eye-dome lighting on and off" },
  { "+", KeyAction::Larger, "larger points" },
  { "-", KeyAction::Smaller, "smaller points" },
  { "k", KeyAction::Classes, "the list of classes" },
  { "Up", KeyAction::Up, "in the list: the class above" },
  { "Down", KeyAction::Down, "in the list: the class below" },
  { "Return", KeyAction::Toggle, "in the list: show or hide the class" },
  { "r", KeyAction::ShowAll, "show all" },
  { "1", KeyAction::ViewIso, "look from the south-east, from above" },
  { "2", KeyAction::ViewTop, "look straight down" },
  { "3", KeyAction::ViewFront, "look from the south" },
  { "4", KeyAction::ViewBack, "look from the north" },
  { "5", KeyAction::ViewLeft, "look from the west" },
  { "6", KeyAction::ViewRight, "look from the east" },
  { "o", KeyAction::Projection, "parallel or perspective view" },
  { "g", KeyAction::Screenshot, "grab a picture: pointfront-1.png" },
  { "v", KeyAction::SaveCamera, "save the view: pointfront-camera-1.json" },
  { "b", KeyAction::RestoreCamera, "back to the view that was saved last" },
  { "Escape", KeyAction::Escape, "close what lies over the picture" },
  { "q", KeyAction::Quit, "end" },
} };

/// Actions of the mouse and of keys that are held (Flight), a line each.
constexpr std::array<KeyBinding, 7> mouseTable{ {
  { "click", KeyAction::None, "what the store holds of the point" },
  { "left drag", KeyAction::None, "turn around the point under the mouse" },
  { "middle drag", KeyAction::None, "move the picture (also Shift and left drag)" },
  { "right drag", KeyAction::None, "turn the head" },
  { "wheel", KeyAction::None, "nearer to or farther from the point under the mouse" },
  { "w a s d", KeyAction::None, "fly forward, left, back, right; Shift: faster" },
  { "PgUp PgDn", KeyAction::None, "fly up, down" },
} };

/// `keysym`: the X name of a key ("question", "c"). None for a key without a meaning.
KeyAction keyActionOf(std::string_view keysym);
/// Mouse and keys, a line each, in two columns.
std::string keyHelp();

} // namespace pointfront
