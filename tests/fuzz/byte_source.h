#pragma once

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gumcert::fuzz {

/// Choices and numbers from the bytes of a fuzzer, from the front; zeros where they are used up.
class ByteSource {
public:
    explicit ByteSource(std::string_view bytes) : rest_(bytes) {}

    [[nodiscard]] bool empty() const { return rest_.empty(); }

    std::uint8_t byte() {
        if (rest_.empty()) {
            return 0;
        }
        const auto first = static_cast<std::uint8_t>(rest_.front());
        rest_.remove_prefix(1);
        return first;
    }
    std::uint64_t bits(int bytes) {
        std::uint64_t bits = 0;
        for (int i = 0; i < bytes; ++i) {
            bits = bits << 8U | byte();
        }
        return bits;
    }
    /// \param n  at least 1, at most 256
    std::size_t below(std::size_t n) { return byte() % n; }
    /// From `least` to `most`.
    int between(int least, int most) {
        return least + static_cast<int>(bits(2) % static_cast<std::uint64_t>(most - least + 1));
    }
    /// From 0 to 1.
    double share() { return static_cast<double>(bits(4)) / 4294967295.0; }

    /// Any double: by its bits; or, as people write numbers, with few decimal digits.
    double number() {
        if (below(4) == 0) {
            return std::bit_cast<double>(bits(8));
        }
        const auto digits = static_cast<std::int64_t>(bits(1 + static_cast<int>(below(6))));
        const std::string text =
            (below(2) == 0 ? "" : "-") + std::to_string(digits) + 'e' + std::to_string(between(-40, 25));
        double value = 0.0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        return value;
    }

    [[nodiscard]] std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
};

}  // namespace gumcert::fuzz
