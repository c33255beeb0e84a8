#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace gumcert::fuzz {

/// A text changed by libFuzzer itself: bytes, words of the dictionary, what comparisons in the program looked for.
inline std::string mutated_text(std::string text) {
    constexpr std::size_t k_room = 64;
    const std::size_t size = text.size();
    text.resize(size + k_room);
    text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
    return text;
}

/// Hands a text back to libFuzzer, cut where it has no room for more.
inline std::size_t put_back(const std::string& text, std::uint8_t* data, std::size_t max_size) {
    const std::size_t size = std::min(text.size(), max_size);
    std::memcpy(data, text.data(), size);
    return size;
}

}  // namespace gumcert::fuzz
