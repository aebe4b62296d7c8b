#include "FrameFacts.h"

#include "FactsText.h"
#include "MappedStores.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkRenderWindow.h>

#include <utility>

namespace pointfront
{

FrameFacts::FrameFacts(vtkRenderWindow* window, vtkRenderer* renderer, const MappedStores& stores,
  std::function<void()> drawn)
  : window_(window)
  , stores_(stores)
  , drawn_(std::move(drawn))
  , panel_(renderer, TextPanel::Corner::UpperRight)
{
  command_->SetClientData(this);
  command_->SetCallback(
    [](vtkObject*, unsigned long event, void* self, void*)
    {
      auto* const facts = static_cast<FrameFacts*>(self);
      event == vtkCommand::StartEvent ? facts->begin() : facts->end();
    });
  window_->AddObserver(vtkCommand::StartEvent, command_);
  window_->AddObserver(vtkCommand::EndEvent, command_);
}

FrameFacts::~FrameFacts()
{
  window_->RemoveObserver(command_);
}

void FrameFacts::toggle()
{
  shown_ = !shown_;
  write();
}

void FrameFacts::hide()
{
  shown_ = false;
  write();
}

void FrameFacts::write()
{
  FrameRecord frame = stores_.record();
  frame.milliseconds = milliseconds_;
  panel_.set(shown_ ? factsText(frame, stores_.loading() != nullptr) : "");
}

void FrameFacts::begin()
{
  if (shown_ && !own_)
  {
    write();
  }
  begin_ = Clock::now();
}

void FrameFacts::end()
{
  if (!own_)
  {
    milliseconds_ = std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
    stale_ = true;
  }
  own_ = false;
  drawn_();
}

bool FrameFacts::wantsFrame()
{
  if (!shown_ || !stale_)
  {
    return false;
  }
  stale_ = false;
  own_ = true;
  write();
  return true;
}

} // namespace pointfront
