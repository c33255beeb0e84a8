#include "app/cli/archive/lookup.h"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/cli/archive/action.h"
#include "app/cli/terminal/terminal.h"
#include "archive/archive.h"
#include "archive/certificates/archive_statistics.h"
#include "encoding/sha2.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

using nlohmann::json;

json shown_entry(const archive::LogEntry& entry) {
    return {{"seq", entry.seq},
            {"at", entry.at},
            {"by", entry.actor},
            {"kind", entry.kind},
            {"record", entry.record},
            {"request_key", entry.request_key},
            {"body", archive::body_of(entry).value_or(json())},
            {"hash", encoding::hexadecimal(entry.hash)}};
}

std::string shown_changes(const json& body) {
    std::string text;
    const auto amends = body.find("amends");
    if (amends == body.end() || !amends->is_object() || !amends->contains("changes")) {
        return text;
    }
    for (const json& change : (*amends)["changes"]) {
        const auto part = [&](const char* key) {
            const auto found = change.find(key);
            const std::string value = found != change.end() && found->is_string() ? found->get<std::string>() : "";
            return value.empty() ? std::string("nothing") : text::one_line(value);
        };
        text += fmt::format("        {} {}: {} -> {}\n", part("where"), part("kind"), part("before"), part("after"));
    }
    return text;
}

}  // namespace

ExitCode list_certificates(const ArchiveOptions& options, const CommonOptions& /*common*/) {
    const auto store = opened(options, archive::Access::read_only);
    std::vector<archive::ListedCertificate> certificates = archive::Archive(*store).list();
    for (const std::string& word : options.named) {
        std::erase_if(certificates, [wanted = text::in_small_letters(word)](const archive::ListedCertificate& one) {
            return text::in_small_letters(one.number + '\n' + one.state + '\n' + one.since + '\n' + one.item)
                       .find(wanted) == std::string::npos;
        });
    }
    if (as_json(options)) {
        json list = json::array();
        for (const archive::ListedCertificate& one : certificates) {
            list.push_back({{"number", one.number},
                            {"state", one.state},
                            {"since", one.since},
                            {"item", one.item},
                            {"record", one.record}});
        }
        print_json({{"schema", "gumcert/archive-list/1"}, {"certificates", list}});
        return done;
    }
    std::string text;
    for (const archive::ListedCertificate& one : certificates) {
        text += fmt::format("{:<24}  {:<10}  {}  {}\n", text::one_line(one.number), text::one_line(one.state),
                            text::one_line(one.since), text::one_line(one.item));
    }
    write_to_stdout(text.empty() ? "No certificates.\n" : text);
    return done;
}

ExitCode show_certificate(const ArchiveOptions& options, const CommonOptions& /*common*/) {
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    const std::string& number = options.named.front();
    const std::vector<archive::LogEntry> entries = archive.history(number);
    const archive::CertificateLife life = archive.life(number);
    if (as_json(options)) {
        json list = json::array();
        for (const archive::LogEntry& entry : entries) {
            list.push_back(shown_entry(entry));
        }
        print_json({{"schema", "gumcert/archive-certificate/1"},
                    {"number", number},
                    {"state", life.state},
                    {"since", life.since},
                    {"record", life.record},
                    {"documents", life.documents},
                    {"amends", life.amends},
                    {"amended_by", life.later},
                    {"entries", list}});
        return done;
    }
    // Every text here is one that somebody wrote: none of them may bring a line of its own.
    std::string text = fmt::format("{}: {} since {}\n", text::one_line(number), text::one_line(life.state),
                                   text::one_line(life.since));
    if (!life.amends.empty()) {
        text += fmt::format("  {} {}\n", life.amendment_kind == "replaced" ? "replaces" : "amends",
                            text::one_line(life.amends));
    }
    std::set<std::string> seen{number};
    for (std::string later = life.later; !later.empty() && seen.insert(later).second;) {
        const archive::CertificateLife of_later = archive.life(later);
        text += fmt::format("  see {}, which is {} since {}\n", text::one_line(later), text::one_line(of_later.state),
                            text::one_line(of_later.since));
        later = of_later.later;
    }
    for (const archive::LogEntry& entry : entries) {
        const json body = archive::body_of(entry).value_or(json::object());
        text += fmt::format("  {:>6}  {}  {:<10}  {}", entry.seq, text::one_line(entry.at), text::one_line(entry.kind),
                            text::one_line(entry.actor));
        const auto why = body.find("why");
        text += why != body.end() && why->is_string() && !why->get_ref<const std::string&>().empty()
                    ? ": " + text::one_line(why->get_ref<const std::string&>()) + "\n"
                    : "\n";
        if (entry.kind == "drafted") {
            text += fmt::format("        record {}\n", text::one_line(entry.record));
            const json documents = body.value("new", json::object()).value("documents", json::array());
            for (const json& document : documents) {
                text += fmt::format("        {} {}\n", text::one_line(document.value("name", "")),
                                    text::one_line(document.value("sha256", "")));
            }
            text += shown_changes(body);
        }
    }
    write_to_stdout(text);
    return done;
}

ExitCode show_statistics(const ArchiveOptions& options, const CommonOptions&) {
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    const archive::ArchiveStatistics statistics = archive::statistics_of(archive);
    write_to_stdout(as_json(options) ? archive::statistics_json(statistics) : archive::statistics_text(statistics));
    return done;
}

}  // namespace gumcert::cli
