#include "reports/record/evaluation_record.h"

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "text/utf8.h"

namespace gumcert::reports {

InputFile input_file(const std::string& name, const std::string& bytes, bool with_content) {
    InputFile file{.name = name, .sha256 = encoding::sha256(bytes)};
    if (with_content) {
        const bool text = text::is_utf8(bytes) && bytes.find('\0') == std::string::npos;
        file.content = text ? bytes : encoding::base64(bytes);
        file.encoding = text ? "utf-8" : "base64";
    }
    return file;
}

std::optional<std::string> bytes_of(const InputFile& file) {
    return file.encoding == "base64" && file.content ? encoding::bytes_from_base64(*file.content) : file.content;
}

}  // namespace gumcert::reports
