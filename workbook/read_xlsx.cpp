#include "workbook/read_xlsx.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "text/visible_text.h"
#include "workbook/limits.h"
#include "workbook/package_parts.h"
#include "workbook/sheet_part.h"
#include "workbook/workbook_parts.h"

namespace gumcert::workbook {

namespace {

void refuse_other_files(std::string_view bytes, const std::string& file) {
    if (bytes.size() > k_largest_file) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0001",
                                              .where = file,
                                              .what = std::to_string(bytes.size()) + " bytes",
                                              .rule = "workbooks are read up to 20 MB",
                                              .action = "store what is to be looked at as a workbook of its own"});
    }
    if (bytes.starts_with("\xD0\xCF\x11\xE0")) {
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-WORKBOOK-0003",
            .where = file,
            .what = "a workbook in the old binary format (.xls), or one that needs a password to be opened",
            .rule = "workbooks are read as .xlsx without a password",
            .action = "open it in a spreadsheet program and store it as .xlsx, without a password"});
    }
    if (!bytes.starts_with("PK")) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0002",
                                              .where = file,
                                              .what = "no ZIP archive",
                                              .rule = "a workbook is an .xlsx or .xlsm file",
                                              .action = "store it as .xlsx with a spreadsheet program"});
    }
}

std::string folder_and_name(const std::string& part, std::string_view added_folder, std::string_view ending) {
    const std::size_t slash = part.rfind('/');
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    return part.substr(0, name) + std::string(added_folder) + part.substr(name) + std::string(ending);
}

class PackageReader {
public:
    PackageReader(std::string_view bytes, std::string file) : file_(std::move(file)), parts_(bytes, file_) {}

    Workbook read() {
        const std::string part = workbook_part();
        const std::string where = place(part);
        WorkbookPart named = read_workbook_part(parts_.read(part), where, texts_);
        const auto relationships = relationships_of(part);
        workbook_.defined_names = std::move(named.defined_names);
        workbook_.metadata.structure_is_protected = named.structure_is_protected;
        workbook_.metadata.dates_from_1904 = named.dates_from_1904;
        workbook_.metadata.precision_as_displayed = named.precision_as_displayed;
        workbook_.metadata.iterates = named.iterates;
        if (named.sheets.empty()) {
            throw bad_content(where, "a workbook without a sheet");
        }
        read_common_parts(part, relationships);
        for (NamedSheet& sheet : named.sheets) {
            read_sheet(part, std::move(sheet), relationships);
        }
        for (const std::string& id : named.external_links) {
            read_link(part, id, relationships);
        }
        name_unexamined_parts();
        return std::move(workbook_);
    }

private:
    using Relationships = std::map<std::string, Relationship>;

    [[nodiscard]] std::string place(const std::string& part) const { return file_ + "#" + text::visible(part); }

    Relationships relationships_of(const std::string& part) {
        const std::string name = folder_and_name(part, "_rels/", ".rels");
        return parts_.has(name) ? read_relationships(parts_.read(name), place(name)) : Relationships();
    }

    /// The part of the workbook, and what the file says of itself.
    std::string workbook_part() {
        std::string found;
        for (const auto& [id, one] : relationships_of("")) {
            if (one.is_external) {
                continue;
            }
            if (one.type == "officeDocument") {
                found = part_name("", one.target, place("_rels/.rels"));
            } else if (one.type == "core-properties" || one.type == "extended-properties") {
                const std::string part = part_name("", one.target, place("_rels/.rels"));
                if (parts_.has(part)) {
                    read_properties(parts_.read(part), place(part), workbook_.metadata);
                }
            }
        }
        if (found.empty() && parts_.has("xl/workbook.xml")) {
            found = "xl/workbook.xml";
        }
        if (found.empty() || found.ends_with(".bin")) {
            throw gum::InputError(gum::Diagnostic{
                .code = "GC-WORKBOOK-0002",
                .where = file_,
                .what = found.ends_with(".bin") ? "a binary workbook (.xlsb)" : "an archive without a workbook in it",
                .rule = "a workbook is an .xlsx or .xlsm file",
                .action = "store it as .xlsx with a spreadsheet program"});
        }
        return found;
    }

    void read_common_parts(const std::string& workbook_part, const Relationships& relationships) {
        for (const auto& [id, one] : relationships) {
            if (one.is_external || (one.type != "sharedStrings" && one.type != "styles")) {
                continue;
            }
            const std::string part = part_name(workbook_part, one.target, place(workbook_part));
            if (one.type == "sharedStrings") {
                strings_ = read_shared_strings(parts_.read(part), place(part));
            } else {
                NumberFormats formats = read_number_formats(parts_.read(part), place(part), texts_);
                workbook_.number_formats = std::move(formats.texts);
                formats_ = std::move(formats.of_style);
            }
        }
    }

    void read_sheet(const std::string& workbook_part, NamedSheet named, const Relationships& relationships) {
        Sheet& sheet = workbook_.sheets.emplace_back();
        sheet.name = std::move(named.name);
        sheet.state = named.state;
        const auto found = relationships.find(named.relationship);
        if (found == relationships.end() || found->second.is_external) {
            throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0010",
                                                  .where = place(workbook_part),
                                                  .what = "no part of the sheet " + text::in_quotes(sheet.name),
                                                  .rule = "what a workbook is made of stands in its own file",
                                                  .action = "store the workbook again with a spreadsheet program"});
        }
        if (found->second.type != "worksheet") {
            workbook_.metadata.not_examined.push_back("the sheet " + text::in_quotes(sheet.name) + ", a " +
                                                      text::visible(found->second.type));
            return;
        }
        const std::string part = part_name(workbook_part, found->second.target, place(workbook_part));
        const SheetSurroundings surroundings{
            .shared_strings = strings_, .format_of_style = formats_, .texts = texts_, .cells_left = cells_left_};
        read_sheet_part(parts_.read(part), place(part), surroundings, sheet);
    }

    void read_link(const std::string& workbook_part, const std::string& id, const Relationships& relationships) {
        ExternalLink link{.kind = "workbook", .target = ""};
        const auto found = relationships.find(id);
        if (found != relationships.end() && !found->second.is_external) {
            const std::string part = part_name(workbook_part, found->second.target, place(workbook_part));
            LinkPart read = read_link_part(parts_.read(part), place(part));
            link = {.kind = read.kind.empty() ? "workbook" : read.kind, .target = std::move(read.target)};
            const Relationships targets = relationships_of(part);
            if (const auto target = targets.find(read.relationship); target != targets.end()) {
                link.target = target->second.target;
            }
        }
        workbook_.external_links.push_back(std::move(link));
    }

    void name_unexamined_parts() {
        constexpr std::pair<std::string_view, std::string_view> k_kinds[] = {{"vbaproject", "macros"},
                                                                             {"/charts/", "charts"},
                                                                             {"/drawings/", "drawings"},
                                                                             {"/embeddings/", "embedded files"},
                                                                             {"/pivottables/", "pivot tables"},
                                                                             {"/connections", "connections to data"},
                                                                             {"/querytables/", "queries of data"},
                                                                             {"/comments", "comments"},
                                                                             {"/media/", "pictures"}};
        const std::vector<std::string> names = parts_.names();
        for (const auto& [in_name, kind] : k_kinds) {
            if (std::any_of(names.begin(), names.end(),
                            [&in = in_name](const std::string& name) { return name.find(in) != std::string::npos; })) {
                workbook_.metadata.not_examined.emplace_back(kind);
            }
        }
    }

    std::string file_;
    PackageParts parts_;
    Workbook workbook_;
    std::vector<std::string> strings_;
    std::vector<std::uint32_t> formats_;
    TextAllowance texts_{k_largest_texts};
    std::size_t cells_left_ = k_most_cells;
};

}  // namespace

Workbook read_xlsx(std::string_view bytes, const std::string& file) {
    const std::string where = text::visible(file);
    refuse_other_files(bytes, where);
    return PackageReader(bytes, where).read();
}

}  // namespace gumcert::workbook
