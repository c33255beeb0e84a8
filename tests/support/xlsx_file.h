#pragma once

#include <zip.h>

#include <string>
#include <utility>
#include <vector>

namespace gumcert::test {

/// Name and bytes of each part of an archive.
using Parts = std::vector<std::pair<std::string, std::string>>;

/// A ZIP archive of parts, in their order; of two of one name the first.
inline std::string archive_of(const Parts& parts) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const target = zip_source_buffer_create(nullptr, 0, 0, &error);
    zip_t* const archive = zip_open_from_source(target, ZIP_TRUNCATE, &error);
    zip_source_keep(target);
    for (const auto& [name, bytes] : parts) {
        zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
        const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
        if (index < 0) {  // a name that is there already, or none
            zip_source_free(source);
            continue;
        }
        // The fastest way: bombs of tests are large.
        zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_DEFLATE, 1);
        zip_file_set_mtime(archive, static_cast<zip_uint64_t>(index), 1577836800, 0);
    }
    if (zip_close(archive) != 0) {
        zip_discard(archive);
    }
    zip_source_open(target);
    std::string bytes;
    std::vector<char> buffer(65536);
    for (zip_int64_t count = 0; (count = zip_source_read(target, buffer.data(), buffer.size())) > 0;) {
        bytes.append(buffer.data(), static_cast<std::size_t>(count));
    }
    zip_source_close(target);
    zip_source_free(target);
    zip_error_fini(&error);
    return bytes;
}

/// A part of a workbook: the elements inside of its root, with the namespaces that they need.
inline std::string xml_part(const std::string& root, const std::string& inside) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n<" + root +
           " xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\""
           " xmlns:r=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships\">" +
           inside + "</" + root + ">";
}

inline std::string relationships_part(const std::string& inside) {
    return "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">" + inside +
           "</Relationships>";
}

/// One arrow; its type is the last word of the standard's address.
inline std::string relationship(const std::string& id, const std::string& type, const std::string& target,
                                const std::string& more = "") {
    return "<Relationship Id=\"" + id +
           "\" Type=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships/" + type + "\" Target=\"" +
           target + "\"" + more + "/>";
}

/// What a workbook of a test is made of: XML where a test is about it, and what every workbook needs.
struct XlsxFile {
    /// Rows of each sheet, `<row r="1">…</row>`, by its name.
    std::vector<std::pair<std::string, std::string>> sheets{{"Sheet1", ""}};
    std::string behind_sheets;       ///< in the part of the workbook: defined names, calcPr, protection
    std::string behind_cells;        ///< in each sheet, behind its cells
    std::string sheet_attributes;    ///< of each `<sheet …>`
    std::string shared_strings;      ///< `<si>…</si>`
    std::string styles;              ///< inside of `<styleSheet>`
    std::string more_relationships;  ///< of the workbook
    Parts more_parts;

    [[nodiscard]] Parts parts() const {
        std::string named, arrows;
        Parts sheet_parts;
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            const std::string number = std::to_string(i + 1);
            named += "<sheet name=\"" + sheets[i].first + "\" sheetId=\"" + number + "\" " + sheet_attributes +
                     " r:id=\"rId" + number + "\"/>";
            arrows += relationship("rId" + number, "worksheet", "worksheets/sheet" + number + ".xml");
            sheet_parts.emplace_back(
                "xl/worksheets/sheet" + number + ".xml",
                xml_part("worksheet", "<sheetData>" + sheets[i].second + "</sheetData>" + behind_cells));
        }
        Parts all{{"_rels/.rels", relationships_part(relationship("rId1", "officeDocument", "xl/workbook.xml"))},
                  {"xl/workbook.xml", xml_part("workbook", "<sheets>" + named + "</sheets>" + behind_sheets)}};
        if (!shared_strings.empty()) {
            arrows += relationship("rIdStrings", "sharedStrings", "sharedStrings.xml");
            all.emplace_back("xl/sharedStrings.xml", xml_part("sst", shared_strings));
        }
        if (!styles.empty()) {
            arrows += relationship("rIdStyles", "styles", "styles.xml");
            all.emplace_back("xl/styles.xml", xml_part("styleSheet", styles));
        }
        all.emplace_back("xl/_rels/workbook.xml.rels", relationships_part(arrows + more_relationships));
        all.insert(all.end(), sheet_parts.begin(), sheet_parts.end());
        all.insert(all.end(), more_parts.begin(), more_parts.end());
        return all;
    }

    [[nodiscard]] std::string bytes() const { return archive_of(parts()); }
};

}  // namespace gumcert::test
