// Linked into a program, stops it at a floating-point operation that is invalid, divides by zero or
// overflows: with select() instead of if, such an operation may be on the side not taken and leave
// no trace in any result. See OVERTURN_TRAP. UntrappedFloatingPoint makes exceptions, as does the
// environment variable OVERTURN_UNTRAPPED for a whole program.
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <execinfo.h>
#include <fenv.h>
#include <unistd.h>

namespace {

/// This must not allocate: the signal may interrupt any code.
void say(const char* text)
{
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

const char* name_of(int code)
{
    switch (code) {
    case FPE_FLTINV: return "an invalid operation";
    case FPE_FLTDIV: return "a division by zero";
    case FPE_FLTOVF: return "an overflow";
    default: return "an arithmetic exception";
    }
}

void report(int, siginfo_t* signal, void*)
{
    say("floating-point trap: ");
    say(name_of(signal->si_code));
    say(". Lines of an address: addr2line -Cfie PROGRAM ADDRESS\n");
    std::array<void*, 32> frames;
    backtrace_symbols_fd(frames.data(), backtrace(frames.data(), int(frames.size())),
                         STDERR_FILENO);
    // The operation is repeated and ends the program with the signal.
}

[[maybe_unused]] const bool trapped = [] {
    if (std::getenv("OVERTURN_UNTRAPPED") != nullptr) {
        return false;
    }
    std::array<void*, 1> frame;
    backtrace(frame.data(), int(frame.size())); // the first call loads a library, which allocates
    struct sigaction action = {};
    action.sa_sigaction = report;
    action.sa_flags = SA_SIGINFO | int(SA_RESETHAND);
    sigaction(SIGFPE, &action, nullptr);
    if (feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == -1) {
        say("OVERTURN_TRAP: this processor does not trap floating-point exceptions.\n");
        _exit(1);
    }
    return true;
}();

} // namespace
