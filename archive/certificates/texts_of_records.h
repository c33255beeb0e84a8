#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "archive/certificates/standard_references.h"

namespace gumcert::archive {

/// Which records say which text by which they rest on something. A name is looked for in the texts that have its rarest word:
/// of 100 000 certificates each may have a text of its own, and each is a name that others may rest on.
class TextsOfRecords {
public:
    /// \param record  in which it says so; added in ascending order
    void add(std::size_t record, const RecordReferences& references);

    /// Records with a text that names something, archive::names().
    [[nodiscard]] std::set<std::size_t> that_name(const std::string& name) const;
    /// Texts that name nothing else than `name` but for their spelling: "std-017", "STD\u2011017, certificate 12".
    [[nodiscard]] std::set<std::string> that_may_mean(const std::string& name) const;

private:
    using Text = std::pair<const std::string, std::vector<std::size_t>>;  // and the records that say it
    std::map<std::string, std::vector<std::size_t>> records_;
    std::unordered_map<std::string_view, std::vector<const Text*>> with_word_;  // words of the keys of records_
};

}  // namespace gumcert::archive
