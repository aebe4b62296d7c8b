#pragma once

#include "pointfront/Base/Result.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <string>

namespace pointfront
{

/// Keeps the first error that any of the observed objects reports; VTK then prints none.
class ErrorListener
{
public:
  ErrorListener()
  {
    command_->SetClientData(this);
    command_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        if (self != nullptr) // the observed object may outlive this one
        {
          static_cast<ErrorListener*>(self)->hear(static_cast<const char*>(text));
        }
      });
  }
  ~ErrorListener() { command_->SetClientData(nullptr); }
  ErrorListener(const ErrorListener&) = delete;
  ErrorListener& operator=(const ErrorListener&) = delete;

  void observe(vtkObject* object) { object->AddObserver(vtkCommand::ErrorEvent, command_); }
  /// Its warnings are told otherwise: VTK then prints none.
  void ignoreWarnings(vtkObject* object)
  {
    vtkNew<vtkCallbackCommand> nothing;
    object->AddObserver(vtkCommand::WarningEvent, nothing);
  }
  Result<void> outcome() const
  {
    return first_.empty() ? Result<void>() : makeError(Error::Kind::Corrupt, first_);
  }

  /// The same, and forgets it: the next error is the first one again.
  Result<void> take()
  {
    Result<void> heard = outcome();
    first_.clear();
    return heard;
  }

private:
  /// VTK's text: "ERROR: In FILE, line N\nCLASS (ADDRESS): WHAT\n\n". Users want WHAT.
  void hear(const char* text)
  {
    if (!first_.empty() || text == nullptr)
    {
      return;
    }
    first_ = text;
    const std::string::size_type begin = first_.find("): ");
    if (first_.compare(0, 6, "ERROR:") == 0 && begin != std::string::npos)
    {
      first_.erase(0, begin + 3);
    }
    first_.erase(first_.find_last_not_of("\n ") + 1);
  }

  vtkNew<vtkCallbackCommand> command_;
  std::string first_;
};

} // namespace pointfront
