#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::archive {

/// A text by which a record says what it rests on.
struct StandardReference {
    enum class Kind {
        registered,  ///< a file of the register of standards was read: identification, certificates of its calibrations
        traceability,  ///< a row of the standards that the certificate lists: identification, certificate
        source         ///< where an input, a component or a condition comes from, in words
    };
    Kind kind = Kind::source;
    std::string text;
};

/// "register", "traceability" or "source".
[[nodiscard]] const char* word_of(StandardReference::Kind kind);

/// What a record says of one certificate.
struct RecordReferences {
    std::vector<StandardReference> references;  ///< each one once
    /// Days of the work, "2026-11-18". Where no first day is stated, none is known. The last one is stated, or the first, or the
    /// day of the authorisation or issue, before which the work was done; "" without any.
    std::string used_from, used_to;
};

/// Everything by which a record names standards: files of the register, rows of traceability, and texts at the keys
/// `source`, `sensor`, `standard` and `standards`, wherever they stand.
/// \param record  its bytes
/// \return none where it is no JSON object
[[nodiscard]] std::optional<RecordReferences> references_of(std::string_view record);

/// Where a file of a job states something of a standard itself, in place of taking it from the register: a text at the key
/// `source` or `sensor` that names it, but beside such a `standard`, and a row of `standards` with members. JSON pointers, in
/// their order. Here blanks and hyphens make no other name.
/// \param standard  its name, and those of its certificates
[[nodiscard]] std::vector<std::string> stated_by_hand(const nlohmann::json& file,
                                                      const std::vector<std::string>& standard);

/// Whether a text names something: all of it is the name, or the name stands in it as a word of its own. "STD-017" stands in
/// "STD-017, certificate 12", in quotes of any language and in Chinese without blanks, and neither in "STD-0171" nor in "STD-017-2"
/// or "STD-017/A1". A name in letters of a script without blanks between words, or in Korean, stands in every text that has its
/// letters: 標準器 in 用標準器校準, and in 標準器具, for nobody can tell the two apart, and one standard that is missed is worse.
[[nodiscard]] bool names(std::string_view text, std::string_view name);

/// The letters and digits of ASCII that stand together in a text: "STD" and "017" of "STD-017". Whatever text names something has
/// all words of the name among its own.
[[nodiscard]] std::vector<std::string_view> plain_words_of(std::string_view text);

/// Identification of the standard whose file of the register it is: "STD-017" of "laboratory/standards/STD-017.json"; ""
/// of other files.
[[nodiscard]] std::string standard_of_file(std::string_view name);

}  // namespace gumcert::archive
