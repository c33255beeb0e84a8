#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// Labels and sentences of one language (templates/wording/<language>.json). A text that is missing is an error: a
/// document is never printed with a hole.
class Wording {
public:
    using Values = std::vector<std::pair<std::string, std::string>>;

    /// \param texts  must outlive this object
    explicit Wording(const nlohmann::json& texts) : texts_(texts) {}

    [[nodiscard]] std::string language() const;
    [[nodiscard]] std::string operator()(const std::string& group, const std::string& name) const;
    [[nodiscard]] std::string operator()(const std::string& group, const std::string& name,
                                         const std::string& item) const;

    /// A text with every `{name}` replaced. Values are placed once and never looked at for names again.
    /// \throws gum::StorageError if the text names a value that is not given
    [[nodiscard]] std::string filled(const std::string& group, const std::string& name, const Values& values) const;
    [[nodiscard]] std::string fill(const std::string& sentence, const Values& values) const {
        return filled("sentence", sentence, values);
    }

private:
    const nlohmann::json& texts_;
};

}  // namespace gumcert::reports
