#pragma once

#include "pointfront/Base/Result.h"

namespace pointfront
{

/// A function of one of the libraries that draw through VTK. Such a library is loaded when somebody
/// asks for what it does and not before: nothing else needs VTK, X or a GL, and a tool that was
/// built without them is the same program.
/// `library`  file name; it lies beside this program's libraries.
/// `what`     begins the message of an Error: what needs the library, and what to use instead.
/// Errors     Unsupported: the library is not installed.
Result<void*> moduleSymbol(const char* library, const char* symbol, const char* what);

} // namespace pointfront
