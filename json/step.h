#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gumcert::json {

/// Where a value stands, as a chain up to its document. The pointer is made where it is asked for: a record has a million
/// values, and few problems. Steps and keys above must outlive it.
struct Step {
    const Step* outer = nullptr;  ///< none: the document itself
    std::string_view key = {};
    std::optional<std::size_t> index = {};  ///< of an element, which has no key

    [[nodiscard]] Step child(std::string_view member) const { return {this, member, {}}; }
    [[nodiscard]] Step child(std::size_t element) const { return {this, {}, element}; }
    /// RFC 6901.
    [[nodiscard]] std::string pointer() const;
};

}  // namespace gumcert::json
