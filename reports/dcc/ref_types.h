#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/forms/render.h"

namespace gumcert::reports {

/// Names by which software finds quantities in a digital certificate (templates/dcc/ref_types.json): data, because the
/// vocabulary grows and a laboratory may have names of its own.
class RefTypes {
public:
    struct Definition {
        std::string space, name, link;
    };

    /// \throws gum::StorageError  GC-DCC-0201 if the file is missing or damaged, or uses a prefix that it does not
    /// define
    [[nodiscard]] static RefTypes read(const RenderAssets& assets);

    [[nodiscard]] const std::vector<Definition>& definitions() const { return definitions_; }
    /// What is written for a word of this program: one or several names; "" for a word that the file does not have.
    [[nodiscard]] std::string operator()(const std::string& word) const;

private:
    std::vector<Definition> definitions_;
    std::vector<std::pair<std::string, std::string>> names_;
};

}  // namespace gumcert::reports
