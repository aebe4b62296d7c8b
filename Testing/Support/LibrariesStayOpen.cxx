// Linked into programs that open a window and that LeakSanitizer checks. It looks for leaks when
// the program ends. The graphics driver is unloaded by then: what its variables point to seems
// lost, and its functions have no name or another library's, so that no suppression would match.
// With the driver still there nothing is reported, and nothing needs to be suppressed.
extern "C" int dlclose(void* /*library*/) noexcept
{
  return 0;
}

// The sanitizer watches where the thread-local variables of a library loaded at run time lie. It
// takes a block that begins 16 bytes into a page for one with glibc 2.19's header, reads its extent
// from what is no header, and the search for leaks crashes there: in 1 of 20 runs, with all tests
// passed. Nothing of ours is reachable from such variables of a driver alone.
extern "C" const char* __asan_default_options() // NOLINT(bugprone-reserved-identifier)
{
  return "intercept_tls_get_addr=0";
}
