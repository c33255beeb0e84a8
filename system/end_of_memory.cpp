#include "system/end_of_memory.h"

#include <libxml/xmlmemory.h>
#include <openssl/crypto.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

namespace gumcert::system {

namespace {

/// What a signature or a document of ordinary size takes while it is looked at.
constexpr std::size_t k_reserve = std::size_t{1} << 20U;

std::atomic<void*> reserve{nullptr};
std::atomic<bool> has_ended{false};

[[noreturn]] void tell_end() {
    has_ended = true;
    throw std::bad_alloc();
}

/// For libraries in C, through which no exception may go.
[[noreturn]] void end_process() noexcept {
    tell_end();
}

/// \param get  asks for memory; asked again when the reserve is given back
/// \return nothing only where more is asked for than a document of ordinary size takes: by a number in the file of somebody
///         else, which libraries look for
template <typename Get>
void* taken(std::size_t size, const Get& get) {
    void* memory = get();
    if (memory == nullptr) {
        if (void* const kept = reserve.exchange(nullptr)) {
            std::free(kept);
            memory = get();
        }
    }
    if (memory == nullptr && size <= k_reserve) {
        end_process();
    }
    return memory;
}

void* take(std::size_t size) {
    return taken(size, [size] { return std::malloc(size); });
}

void* take_again(void* old, std::size_t size) {
    return size == 0 ? std::realloc(old, size) : taken(size, [old, size] { return std::realloc(old, size); });
}

char* take_copy(const char* text) {
    const std::size_t size = std::strlen(text) + 1;
    void* const copy = take(size);
    return copy == nullptr ? nullptr : static_cast<char*>(std::memcpy(copy, text, size));
}

// OpenSSL says in which line of it memory is taken.
void* take_for_openssl(std::size_t size, const char*, int) {
    return take(size);
}

void* take_again_for_openssl(void* old, std::size_t size, const char*, int) {
    return take_again(old, size);
}

void give_back_of_openssl(void* memory, const char*, int) {
    std::free(memory);
}

}  // namespace

void prepare_for_end_of_memory() {
    std::set_new_handler(tell_end);
    reserve = std::malloc(k_reserve);
    (void)CRYPTO_set_mem_functions(take_for_openssl, take_again_for_openssl, give_back_of_openssl);
    (void)xmlMemSetup(std::free, take, take_again, take_copy);
}

bool memory_has_ended() {
    return has_ended;
}

void require_memory() {
    if (has_ended) {
        throw std::bad_alloc();
    }
}

}  // namespace gumcert::system
