#include "BackgroundBuild.h"

#include "pointfront/Threads/ThreadPriority.h"

#include "vtkCommand.h"
#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkPointFrontBuilder.h"

#include <utility>

namespace pointfront
{
namespace
{

/// Views go first. Processes that wait for each other actively (MPI) count as such: with as many
/// builders as processors they got nothing to see before the build's end.
constexpr int niceness = 10;

/// The message of an event: without the source line and the object that VTK puts before it, and
/// with the property's label for its name.
std::string messageOf(const void* data)
{
  std::string text = static_cast<const char*>(data);
  const std::size_t object = text.find("): ");
  text = object == std::string::npos ? text : text.substr(object + 3);
  const std::string property = "AssumedCRS";
  if (const std::size_t place = text.find(property); place != std::string::npos)
  {
    text.replace(place, property.size(), "Assumed CRS");
  }
  const std::size_t end = text.find_last_not_of('\n');
  return text.substr(0, end == std::string::npos ? 0 : end + 1);
}

} // namespace

/// Notes what the builder tells, on the builder's thread.
class BackgroundBuild::Observer final : public vtkCommand
{
public:
  static Observer* New() { return new Observer; }
  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    auto* builder = static_cast<vtkPointFrontBuilder*>(caller);
    const std::lock_guard<std::mutex> lock(this->Build->mutex_);
    State& state = this->Build->state_;
    switch (event)
    {
      case vtkCommand::ErrorEvent:
        state.error = messageOf(data);
        break;
      case vtkCommand::WarningEvent:
        state.warnings.push_back(messageOf(data));
        break;
      case vtkCommand::UpdateDataEvent:
        state.preview = true;
        break;
      default:
        state.phase = builder->GetProgressText() ? builder->GetProgressText() : "";
        state.fraction = *static_cast<double*>(data);
        if (this->Build->cancel_)
        {
          builder->AbortExecuteOn();
        }
    }
    this->Build->changed_.notify_all();
  }
  BackgroundBuild* Build = nullptr;
};

BackgroundBuild::BackgroundBuild(vtkSmartPointer<vtkPointFrontBuilder> builder, std::string order)
  : builder_(std::move(builder))
  , order_(std::move(order))
  , thread_([this] { this->build(); })
{
}

BackgroundBuild::~BackgroundBuild()
{
  this->cancel();
  thread_.join();
}

void BackgroundBuild::build()
{
  vtkNew<Observer> observer;
  observer->Build = this;
  for (const unsigned long event : { vtkCommand::ProgressEvent, vtkCommand::ErrorEvent,
         vtkCommand::WarningEvent, vtkCommand::UpdateDataEvent })
  {
    builder_->AddObserver(event, observer);
  }
  if (builder_->GetPreview()) // somebody looks at it, and turns it
  {
    lowerThreadPriority(niceness);
  }
  const bool built = builder_->Write() != 0;
  builder_->RemoveObserver(observer);
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.built = built;
  state_.errorCode = builder_->GetErrorCode();
  state_.cancelled = !built && state_.errorCode == vtkErrorCode::UserError;
  state_.ended = true;
  changed_.notify_all();
}

BackgroundBuild::State BackgroundBuild::state() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_;
}

BackgroundBuild::State BackgroundBuild::waitFor(std::chrono::milliseconds longest)
{
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, longest, [this] { return state_.ended; });
  return state_;
}

void BackgroundBuild::cancel()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  cancel_ = true;
}

} // namespace pointfront
