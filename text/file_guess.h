#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::text {

/// What a file is, for the message of a reader that wants another kind of file.
struct FileGuess {
    enum class Form { pdf, packed, xml, json };
    Form form = Form::json;
    std::string what;    ///< "a record of an evaluation"
    std::string action;  ///< "use gumcert render, check or rerun for it"
};

/// Tells by the first bytes and by the key "schema" what a file is: records, jobs, audits and other JSON of this program,
/// data of certificates, XML, PDF, workbooks. Nothing of what is none of these. Reads no more than it needs, and refuses
/// nothing: a text that is broken further on is still what it begins as.
[[nodiscard]] std::optional<FileGuess> guess_file(std::string_view bytes);

/// Behind blanks and a byte-order mark there is a brace, or a comment.
[[nodiscard]] bool begins_as_json_object(std::string_view bytes);

/// The value of a key of the outermost object of a JSON text, where it is a string; nothing of other texts.
[[nodiscard]] std::optional<std::string> outermost_string(std::string_view json, std::string_view key);

}  // namespace gumcert::text
