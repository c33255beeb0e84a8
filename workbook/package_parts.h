#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::workbook {

/// The parts of an .xlsx file, which is a ZIP archive (ECMA-376 Part 2). Names are in small letters without the slash
/// before them; nothing is ever written to a disk, so that a name can name nothing outside.
class PackageParts {
public:
    /// \param bytes  of the file; must outlive the object
    /// \param where  file, for messages
    /// \throws gum::InputError  GC-WORKBOOK-0004 no archive that can be read, -0006 more than 10000 parts
    PackageParts(std::string_view bytes, std::string where);
    PackageParts(const PackageParts&) = delete;
    PackageParts& operator=(const PackageParts&) = delete;
    ~PackageParts();

    [[nodiscard]] bool has(const std::string& name) const;
    /// In the order of the alphabet.
    [[nodiscard]] std::vector<std::string> names() const;
    /// The bytes of a part. All that are asked for together are at most 200 MB, whatever the archive says of their size.
    /// \throws gum::InputError  GC-WORKBOOK-0004 damaged or packed in an unknown way, -0005 too large, -0010 not there
    [[nodiscard]] std::string read(const std::string& name);

private:
    struct Archive;
    std::unique_ptr<Archive> archive_;
};

/// The part that a relationship of another part names: `worksheets/sheet1.xml` of `xl/workbook.xml` is
/// `xl/worksheets/sheet1.xml`.
/// \throws gum::InputError  GC-WORKBOOK-0010 a target outside of the package
[[nodiscard]] std::string part_name(std::string_view base, std::string_view target, const std::string& where);

}  // namespace gumcert::workbook
