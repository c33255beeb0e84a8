#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

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

/// An input changed so that it stays of its format: of each `*_mutator.cpp`, for the functions of libFuzzer in
/// mutator_entry.cpp.
/// \param other  lends parts
std::string changed_input(std::string_view input, std::string_view other, unsigned seed);

}  // namespace gumcert::fuzz
