// Linked into programs that open a window and that LeakSanitizer checks. It looks for leaks when
// the program ends. The graphics driver is unloaded by then: what its variables point to seems
// lost, and its functions have no name or another library's, so that no suppression would match.
// With the driver still there nothing is reported, and nothing needs to be suppressed.
extern "C" int dlclose(void* /*library*/) noexcept
{
  return 0;
}
