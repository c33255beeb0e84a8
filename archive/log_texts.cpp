#include "archive/log_texts.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <set>

#include "encoding/sha2.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

json shown_entry(const LogEntry& entry, bool is_ahead) {
    return {{"seq", entry.seq},
            {"clock_was_ahead", is_ahead},
            {"at", entry.at},
            {"by", entry.actor},
            {"kind", entry.kind},
            {"record", entry.record},
            {"request_key", entry.request_key},
            {"body", body_of(entry).value_or(json())},
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

std::vector<ListedCertificate> with_words(std::vector<ListedCertificate> certificates,
                                          const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        std::erase_if(certificates, [wanted = text::in_small_letters(word)](const ListedCertificate& one) {
            return text::in_small_letters(one.number + '\n' + one.state + '\n' + one.since + '\n' + one.item)
                       .find(wanted) == std::string::npos;
        });
    }
    return certificates;
}

std::string list_text(const std::vector<ListedCertificate>& certificates) {
    std::string text;
    for (const ListedCertificate& one : certificates) {
        text += fmt::format("{:<24}  {:<10}  {}  {}\n", text::one_line(one.number), text::one_line(one.state),
                            text::one_line(one.since), text::one_line(one.item));
    }
    return text.empty() ? "No certificates.\n" : text;
}

json list_json(const std::vector<ListedCertificate>& certificates) {
    json list = json::array();
    for (const ListedCertificate& one : certificates) {
        list.push_back({{"number", one.number},
                        {"state", one.state},
                        {"since", one.since},
                        {"item", one.item},
                        {"record", one.record}});
    }
    return {{"schema", "gumcert/archive-list/1"}, {"certificates", list}};
}

std::string history_text(Archive& archive, const std::string& number) {
    const std::vector<LogEntry> entries = archive.history(number);
    const CertificateLife life = archive.life(number);
    std::string text = fmt::format("{}: {} since {}\n", text::one_line(number), text::one_line(life.state),
                                   text::one_line(life.since));
    if (!life.amends.empty()) {
        text += fmt::format("  {} {}\n", life.amendment_kind == "replaced" ? "replaces" : "amends",
                            text::one_line(life.amends));
    }
    std::set<std::string> seen{number};
    for (std::string later = life.later; !later.empty() && seen.insert(later).second;) {
        const CertificateLife of_later = archive.life(later);
        text += fmt::format("  see {}, which is {} since {}\n", text::one_line(later), text::one_line(of_later.state),
                            text::one_line(of_later.since));
        later = of_later.later;
    }
    const std::set<std::int64_t> ahead = archive.times().ahead();
    for (const LogEntry& entry : entries) {
        const json body = body_of(entry).value_or(json::object());
        const auto clock = body.find(k_clock);
        text += fmt::format("  {:>6}  {}{}  {:<10}  {}", entry.seq, text::one_line(entry.at),
                            clock != body.end() && clock->is_string()
                                ? " (the clock said " + text::one_line(clock->get_ref<const std::string&>()) + ")"
                            : ahead.contains(entry.seq) ? " (a later entry says that this clock was ahead)"
                                                        : "",
                            text::one_line(entry.kind), text::one_line(entry.actor));
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
    return text;
}

json history_json(Archive& archive, const std::string& number) {
    const std::vector<LogEntry> entries = archive.history(number);
    const CertificateLife life = archive.life(number);
    json list = json::array();
    const std::set<std::int64_t> ahead = archive.times().ahead();
    for (const LogEntry& entry : entries) {
        list.push_back(shown_entry(entry, ahead.contains(entry.seq)));
    }
    return {{"schema", "gumcert/archive-certificate/1"},
            {"number", number},
            {"state", life.state},
            {"since", life.since},
            {"record", life.record},
            {"documents", life.documents},
            {"amends", life.amends},
            {"amended_by", life.later},
            {"entries", list}};
}

}  // namespace gumcert::archive
