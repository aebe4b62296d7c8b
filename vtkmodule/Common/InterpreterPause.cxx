#include "InterpreterPause.h"

#include <dlfcn.h>

namespace pointfront
{
namespace
{
/// Functions of Python's C API, stable since 3.4.
struct Interpreter
{
  int (*isInitialized)() = nullptr;
  int (*holdsLock)() = nullptr;
  void* (*release)() = nullptr;
  void (*take)(void*) = nullptr;
  int (*checkSignals)() = nullptr;
  void* (*raised)() = nullptr;

  static const Interpreter& ofProcess()
  {
    static const Interpreter found;
    return found;
  }
  bool complete() const
  {
    return isInitialized && holdsLock && release && take && checkSignals && raised;
  }

private:
  template <typename Function>
  static void find(const char* name, Function& function)
  {
    function = reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
  }
  Interpreter()
  {
    find("Py_IsInitialized", isInitialized);
    find("PyGILState_Check", holdsLock);
    find("PyEval_SaveThread", release);
    find("PyEval_RestoreThread", take);
    find("PyErr_CheckSignals", checkSignals);
    find("PyErr_Occurred", raised);
  }
};
} // namespace

InterpreterPause::InterpreterPause()
{
  const Interpreter& python = Interpreter::ofProcess();
  if (python.complete() && python.isInitialized() != 0 && python.holdsLock() != 0)
  {
    thread_ = python.release();
  }
}

InterpreterPause::~InterpreterPause()
{
  if (thread_ != nullptr)
  {
    Interpreter::ofProcess().take(thread_);
  }
}

InterpreterPause::Resumed::Resumed(InterpreterPause& pause)
  : pause_(pause)
{
  if (pause_.thread_ != nullptr)
  {
    Interpreter::ofProcess().take(pause_.thread_);
  }
}

InterpreterPause::Resumed::~Resumed()
{
  if (pause_.thread_ != nullptr)
  {
    pause_.thread_ = Interpreter::ofProcess().release();
  }
}

bool InterpreterPause::Resumed::interrupted() const
{
  if (pause_.thread_ == nullptr)
  {
    return false;
  }
  const Interpreter& python = Interpreter::ofProcess();
  return python.checkSignals() != 0 || python.raised() != nullptr;
}

} // namespace pointfront
