#ifndef pointfront_ErrorObserver_h
#define pointfront_ErrorObserver_h

#include <vtkCommand.h>

#include <string>

/// Keeps what a VTK object says as errors and warnings, instead of its being printed. VTK has one
/// for its own tests, which not every installed VTK brings along.
class ErrorObserver : public vtkCommand
{
public:
  static ErrorObserver* New() { return new ErrorObserver; }

  void Execute(vtkObject*, unsigned long event, void* text) override
  {
    std::string& kept = event == vtkCommand::WarningEvent ? this->WarningText : this->ErrorText;
    bool& said = event == vtkCommand::WarningEvent ? this->Warned : this->Failed;
    said = said || event == vtkCommand::WarningEvent || event == vtkCommand::ErrorEvent;
    if (text != nullptr)
    {
      kept += static_cast<const char*>(text);
    }
  }

  bool GetError() const { return this->Failed; }
  bool GetWarning() const { return this->Warned; }
  const std::string& GetErrorMessage() const { return this->ErrorText; }
  const std::string& GetWarningMessage() const { return this->WarningText; }
  void Clear()
  {
    this->Failed = this->Warned = false;
    this->ErrorText.clear();
    this->WarningText.clear();
  }

private:
  bool Failed = false;
  bool Warned = false;
  std::string ErrorText;
  std::string WarningText;
};

#endif
