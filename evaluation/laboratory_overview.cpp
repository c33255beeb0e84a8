#include "evaluation/laboratory_overview.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "certificate/dates.h"
#include "encoding/file_bytes.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/file_source.h"
#include "jobs/job_files.h"
#include "jobs/laboratory/laboratory_folder.h"
#include "laboratory/outlook.h"
#include "text/csv_field.h"
#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::evaluation {

namespace {

namespace fs = std::filesystem;

OverviewRow row_of_standard(const laboratory::StandardRecord& record, const std::string& day) {
    const laboratory::CalibrationOutlook outlook = laboratory::calibration_outlook(record, day);
    OverviewRow row{.id = record.id, .description = record.description.in("en")};
    if (outlook.last != nullptr) {
        row.from = outlook.last->calibrated;
        row.certificate = outlook.last->certificate;
        row.to = outlook.last->valid_to;
    }
    row.next = outlook.next;
    row.why = outlook.why;
    row.because = outlook.because;
    switch (outlook.state) {
        case laboratory::CalibrationState::valid:
            row.state = "valid";
            break;
        case laboratory::CalibrationState::overdue:
            row.state = "overdue";
            break;
        case laboratory::CalibrationState::not_calibrated:
            row.state = "not_yet";
            break;
        case laboratory::CalibrationState::unknown:
            row.state = "unknown";
            break;
    }
    return row;
}

/// State of what holds from one day to another.
void state_between(OverviewRow& row, const std::string& day) {
    if (certificate::is_after(day, row.to)) {
        row.state = "overdue";
        row.because = "until " + row.to;
    } else if (certificate::is_after(row.from, day)) {
        row.state = "not_yet";
        row.because = "from " + row.from + " on";
    } else {
        row.state = "valid";
    }
}

std::string text_of(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void read_people(const jobs::LaboratoryFile& file, LaboratoryOverview& overview) {
    for (const jobs::SignatoryStatement& person : file.signatories) {
        OverviewRow row{.id = person.id, .description = person.name, .from = person.from, .to = person.to};
        row.why = person.authorises ? "may authorise" : "signs";
        state_between(row, overview.day);
        overview.signatories.push_back(std::move(row));
    }
    if (file.accreditation.is_object()) {
        OverviewRow row{.id = text_of(file.accreditation, "number"),
                        .description = text_of(file.accreditation, "body"),
                        .from = text_of(file.accreditation, "valid_from"),
                        .to = text_of(file.accreditation, "valid_to")};
        state_between(row, overview.day);
        if (row.to.empty() && row.state == "valid") {
            row.state = "unknown";
            row.because = "the register states no last day";
        }
        overview.accreditation.push_back(std::move(row));
    }
}

using Cells = std::vector<std::string>;

std::string or_dash(const std::string& text) {
    return text.empty() ? "–" : text;
}

/// Columns as wide as their widest cell, the last one without blanks behind it.
std::string in_columns(const std::vector<Cells>& rows) {
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const Cells& row : rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            widths[c] = std::max(widths[c], text::character_count(row[c]));
        }
    }
    std::string all;
    for (const Cells& row : rows) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) {
            line += row[c] + std::string(widths[c] - text::character_count(row[c]) + 2, ' ');
        }
        all += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return all;
}

std::string state_in_words(const OverviewRow& row) {
    const std::string word = row.state == "overdue" ? "OVERDUE" : row.state == "not_yet" ? "not yet" : row.state;
    return word + (row.because.empty() ? "" : ": " + row.because);
}

constexpr std::array<std::string_view, 3> k_parts{"standards", "signatories", "accreditation"};

const std::vector<OverviewRow>& part(const LaboratoryOverview& overview, std::string_view name) {
    return name == "standards"     ? overview.standards
           : name == "signatories" ? overview.signatories
                                   : overview.accreditation;
}

}  // namespace

bool LaboratoryOverview::is_overdue() const {
    return std::any_of(k_parts.begin(), k_parts.end(), [&](std::string_view name) {
        const std::vector<OverviewRow>& rows = part(*this, name);
        return std::any_of(rows.begin(), rows.end(), [](const OverviewRow& row) { return row.state == "overdue"; });
    });
}

bool is_day(const std::string& text) {
    return certificate::calendar_date(text).has_value();
}

bool is_day_somewhere(const std::string& text, const std::string& time) {
    constexpr std::size_t k_day = 10;
    const std::optional<long> days = certificate::days_between(text, time.substr(0, k_day));
    return days && *days >= -1 && *days <= 1;
}

LaboratoryOverview laboratory_overview(const fs::path& folder, const std::string& day) {
    const jobs::DiskFileSource disk(folder, folder);
    jobs::JobFiles files(disk, "");
    jobs::ProblemList unused("");
    std::optional<jobs::LaboratoryFolder> register_files =
        jobs::LaboratoryFolder::of_job(files, jobs::JsonDocument{}, unused);
    LaboratoryOverview overview{.day = day};
    const std::vector<std::string> ids = encoding::json_files_in(folder / "standards");
    std::error_code error;
    const bool has_laboratory = fs::exists(folder / "laboratory.json", error);
    if (!has_laboratory && ids.empty()) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-LAB-0200",
                            .where = text::visible(folder.string()),
                            .what = "neither laboratory.json nor a file standards/ID.json is in it",
                            .rule = "the folder of a laboratory has one of them at least",
                            .action = "name the folder of the laboratory; docs/laboratory.md says what is in it"});
    }
    if (has_laboratory) {
        if (const jobs::LaboratoryFile* file = register_files->laboratory()) {
            read_people(*file, overview);
        }
    }
    for (const std::string& id : ids) {
        if (const laboratory::StandardRecord* record = register_files->standard(id)) {
            overview.standards.push_back(row_of_standard(*record, day));
        }
    }
    files.refuse_if_needed();
    return overview;
}

std::string overview_text(const LaboratoryOverview& overview, const std::string& folder, const std::string& note) {
    std::string all = folder + " on " + overview.day + (note.empty() ? "" : " (" + note + ")") + "\n";
    if (!overview.standards.empty()) {
        std::vector<Cells> rows{
            {"standard", "what it is", "calibrated", "certificate", "valid until", "next by plan", "state", "plan"}};
        for (const OverviewRow& row : overview.standards) {
            rows.push_back({row.id, row.description, or_dash(row.from), or_dash(row.certificate), or_dash(row.to),
                            or_dash(row.next), state_in_words(row), row.why});
        }
        all += "\n" + in_columns(rows);
    }
    if (!overview.signatories.empty()) {
        std::vector<Cells> rows{{"person", "name", "from", "until", "state", "what"}};
        for (const OverviewRow& row : overview.signatories) {
            rows.push_back({row.id, row.description, or_dash(row.from), or_dash(row.to), state_in_words(row), row.why});
        }
        all += "\n" + in_columns(rows);
    }
    if (!overview.accreditation.empty()) {
        std::vector<Cells> rows{{"accreditation", "body", "from", "until", "state"}};
        for (const OverviewRow& row : overview.accreditation) {
            rows.push_back({row.id, row.description, or_dash(row.from), or_dash(row.to), state_in_words(row)});
        }
        all += "\n" + in_columns(rows);
    }
    return all;
}

std::string overview_json(const LaboratoryOverview& overview) {
    const auto text = [](const std::string& value) {
        return value.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
    };
    nlohmann::ordered_json all{{"day", overview.day}, {"overdue", overview.is_overdue()}};
    for (const std::string_view name : k_parts) {
        nlohmann::ordered_json& list = all[std::string(name)] = nlohmann::ordered_json::array();
        for (const OverviewRow& row : part(overview, name)) {
            nlohmann::ordered_json entry{{"id", row.id}, {"description", text(row.description)}};
            if (name == "standards") {
                entry["calibrated"] = text(row.from);
                entry["certificate"] = text(row.certificate);
                entry["valid_to"] = text(row.to);
                entry["next_calibration"] = text(row.next);
                entry["plan"] = text(row.why);
            } else {
                entry["from"] = text(row.from);
                entry["to"] = text(row.to);
            }
            entry["state"] = row.state;
            entry["because"] = text(row.because);
            list.push_back(std::move(entry));
        }
    }
    return all.dump(1) + "\n";
}

std::string overview_csv(const LaboratoryOverview& overview) {
    std::string all = "part,id,description,from,certificate,to,next_calibration,plan,day,state,because\n";
    for (const std::string_view name : k_parts) {
        for (const OverviewRow& row : part(overview, name)) {
            const std::string& plan = name == "standards" ? row.why : std::string();
            std::string line(name);
            for (const std::string& field : {row.id, row.description, row.from, row.certificate, row.to, row.next, plan,
                                             overview.day, row.state, row.because}) {
                line += "," + text::csv_field(field);
            }
            all += line + "\n";
        }
    }
    return all;
}

}  // namespace gumcert::evaluation
