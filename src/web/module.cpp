// What a WebAssembly module exports. A question that is refused ends in the function `refuse` of
// the page, which does not return: it throws an exception of JavaScript, because the C++ library
// for WebAssembly has no exceptions. The page then instantiates the module again.
#include "files_in_memory.hpp"
#include "questions.hpp"

#include "overturn/problem/given.hpp"
#include "overturn/text/error.hpp"

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <typeinfo>

#define OVERTURN_EXPORT(name) [[clang::export_name(#name)]]

extern "C" [[clang::import_module("overturn"), clang::import_name("refuse"), noreturn]] void
overturn_refuse(int code, const char* message, std::size_t size);

namespace overturn {
namespace {

std::string answer; // NOLINT(cert-err58-cpp)

[[noreturn]] void refuse(const std::exception& error)
{
    const auto* const of_user = dynamic_cast<const Error*>(&error);
    const auto* const of_quantity = dynamic_cast<const GivenError*>(&error);
    std::string message = error.what();
    if (of_quantity != nullptr) {
        message = std::string(of_quantity->quantity()) + message;
    }
    overturn_refuse(of_quantity != nullptr ? exit_code::job
                    : of_user != nullptr   ? of_user->code()
                                           : exit_code::internal,
                    message.data(), message.size());
}

} // namespace
} // namespace overturn

extern "C" {

OVERTURN_EXPORT(overturn_allocate) void* overturn_allocate(std::size_t size)
{
    return std::malloc(size);
}

OVERTURN_EXPORT(overturn_release) void overturn_release(void* memory)
{
    std::free(memory);
}

OVERTURN_EXPORT(overturn_add_file)
void overturn_add_file(const char* name, std::size_t name_size, const char* bytes, std::size_t size)
{
    overturn::add_file({name, name_size}, {bytes, size});
}

/// The answer remains until the next question.
OVERTURN_EXPORT(overturn_answer)
const char* overturn_answer(const char* question, std::size_t size)
{
    overturn::answer = overturn::answer_to({question, size});
    return overturn::answer.data();
}

OVERTURN_EXPORT(overturn_answer_size) std::size_t overturn_answer_size()
{
    return overturn::answer.size();
}

// Debian's compiler-rt for WebAssembly is compiled with a stack protector.

std::uintptr_t __stack_chk_guard = 0x5bd1e995; // NOLINT(bugprone-reserved-identifier)

[[noreturn]] void __stack_chk_fail() // NOLINT(bugprone-reserved-identifier)
{
    std::abort();
}

// The division of long double of compiler-rt 19 returns twice the quotient if that rounds up to a
// power of two, such as 2 for 1 / (1 - 2^-113).

long double __real___divtf3(long double a, long double b); // NOLINT(bugprone-reserved-identifier)
long double __wrap___divtf3(long double a, long double b); // NOLINT(bugprone-reserved-identifier)

long double __wrap___divtf3(long double a, long double b) // NOLINT(bugprone-reserved-identifier)
{
    const long double quotient = __real___divtf3(a, b);
    const bool is_doubled = __builtin_fabsl(quotient * b) > 1.5L * __builtin_fabsl(a);
    return is_doubled ? quotient * 0.5L : quotient;
}

// What the compiler calls at `throw`. Every exception of the program derives from std::exception,
// which is its first base.

void* __cxa_allocate_exception(std::size_t size) noexcept // NOLINT(bugprone-reserved-identifier)
{
    return std::malloc(size);
}

void __cxa_free_exception(void* thrown) noexcept // NOLINT(bugprone-reserved-identifier)
{
    std::free(thrown);
}

[[noreturn]] void __cxa_throw(void* thrown, std::type_info* /*type*/, // NOLINT
                              void (* /*destructor*/)(void*))
{
    overturn::refuse(*static_cast<std::exception*>(thrown));
}

} // extern "C"
