#include "imports/import_standard.h"

#include <nlohmann/json.hpp>

#include "json/readable_json.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/printable_text.h"

namespace gumcert::imports {

namespace {

using nlohmann::ordered_json;

/// A line of the register from an input of the job.
ordered_json line_of(const std::string& name, const ordered_json& input) {
    ordered_json line{{"quantity", name}, {"value", input.at("value")}, {"unit", input.at("unit")}};
    if (input.contains("u")) {
        line["U"] = input["u"];
        line["k"] = 1;
    }
    for (const char* key : {"U", "k", "p", "nu"}) {
        if (input.contains(key)) {
            line[key] = input[key];
        }
    }
    return line;
}

void set_if_there(ordered_json& object, const char* key, const std::string& text) {
    if (!text.empty()) {
        object[key] = reports::printable(text);
    }
}

}  // namespace

ImportedJob import_standard(std::string_view bytes, const std::string& file, const std::string& id,
                            const CertificateTrust& trust) {
    ImportedJob imported = import_certificate(bytes, file, trust);
    const reports::ImportedCertificate certificate = reports::read_dcc(bytes, file);
    const ordered_json job = ordered_json::parse(imported.job);
    ordered_json lines = ordered_json::array();
    for (const auto& [name, input] : job.at("inputs").items()) {
        if (!input.contains("constant")) {
            lines.push_back(line_of(name, input));
        }
    }
    if (lines.empty()) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-LAB-0021",
                                              .where = file,
                                              .what = "no result with an uncertainty",
                                              .rule = "the value of a standard has an uncertainty",
                                              .action = "write the file of the standard by hand"});
    }
    ordered_json calibration = ordered_json::object();
    set_if_there(calibration, "calibrated",
                 !certificate.performed_to.empty()     ? certificate.performed_to
                 : !certificate.performed_from.empty() ? certificate.performed_from
                                                       : certificate.issued);
    set_if_there(calibration, "certificate", certificate.identifier);
    set_if_there(calibration, "issuer", certificate.laboratory);
    calibration["sha256"] = certificate.sha256;
    calibration["results"] = std::move(lines);
    const ordered_json standard{{"schema", "gumcert/standard/1"},
                                {"id", id},
                                {"description", certificate.item.empty() ? id : reports::printable(certificate.item)},
                                {"calibrations", ordered_json::array({std::move(calibration)})}};
    imported.job = gumcert::json::readable_json(standard) + "\n";
    imported.remarks.push_back({.code = "GC-LAB-0020",
                                .where = file,
                                .what = "a certificate does not say how the standard drifts, how long it may be used, "
                                        "and by which route it is traceable",
                                .rule = "the laboratory decides on \"drift\", \"valid_to\" and \"route\"",
                                .action = "add them: without \"drift\" the register refuses the file",
                                .severity = gum::Severity::note});
    return imported;
}

}  // namespace gumcert::imports
