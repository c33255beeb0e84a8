#include "app/cli/archive/archive_command.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "app/cli/archive/calculate_again.h"
#include "app/cli/archive/certificate_life.h"
#include "app/cli/archive/lookup.h"
#include "app/cli/archive/proof.h"
#include "app/cli/archive/whole_archive.h"
#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/terminal.h"
#include "archive/certificates/archive_draft.h"
#include "evaluation/laboratory_overview.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

/// Which options an action takes, and how many names.
struct Action {
    const char* name;
    std::size_t least, most;  ///< of what is named
    const char* what;         ///< for the message where the count is another one
    std::string_view takes;   ///< options beside --share and the common ones, with blanks around
    ExitCode (*work)(const ArchiveOptions&, const CommonOptions&);
};

constexpr std::size_t k_any = 100'000;

constexpr std::array<Action, 20> k_actions = {{
    {"init", 0, 0, "nothing more", " store by why format numbering person four ", init_archive},
    {"settings", 0, 0, "nothing more", " store by why today key format numbering person four ", change_settings},
    {"number", 0, 0, "nothing more", " store by why today key format amend ", take_number},
    {"add", 1, k_any, "a record and its documents", " store by why today key format trust ", add_certificate},
    {"review", 1, 1, "the number of a certificate", " store by why today key format ", review_certificate},
    {"authorise", 1, 1, "the number of a certificate", " store by why today key format ", authorise_certificate},
    {"issue", 1, 1, "the number of a certificate", " store by why today key format ", issue_certificate},
    {"amend", 1, k_any, "the record of the amendment and its documents", " store by why today key format trust ",
     amend_certificate},
    {"withdraw", 1, 1, "the number of a certificate", " store by why today key format ", withdraw_certificate},
    {"list", 0, k_any, "words to search for, or nothing for all", " store format ", list_certificates},
    {"show", 1, 1, "the number of a certificate", " store format ", show_certificate},
    {"export", 1, 1, "the number of a certificate", " store output sign since ", export_certificate},
    {"head", 0, 0, "nothing more", " store output sign since ", write_head},
    {"verify", 0, k_any, "files of evidence, or --store", " store format head trust ", verify_archive},
    {"backup", 0, 0, "nothing more", " store by why today key format output ", back_up},
    {"migrate", 0, 0, "nothing more", " store to format ", migrate},
    {"replay", 0, k_any, "numbers of certificates, or nothing for all", " store format shared ", replay},
    {"worker", 0, 0, "nothing more", " store wait ", work_for_others},
    {"statistics", 0, 0, "nothing more", " store format ", show_statistics},
    {"affected", 0, 0, "nothing more", " store why format csv output source since until register shared ",
     find_affected},
}};

struct GivenOption {
    const char* word;  ///< in Action::takes
    const char* name;  ///< as it is typed
    bool given;
};

void require_options(const Action& action, const ArchiveOptions& o) {
    const std::array<GivenOption, 22> given = {{{"store", "--store", !o.store.empty()},
                                                {"to", "--to", !o.to.empty()},
                                                {"by", "--by", !o.by.empty()},
                                                {"why", "--why", !o.why.empty()},
                                                {"key", "--request-key", !o.request_key.empty()},
                                                {"format", "--format", !o.format.empty()},
                                                {"output", "--output", !o.output.empty()},
                                                {"numbering", "--numbering", !o.numbering.empty()},
                                                {"person", "--person", !o.persons.empty()},
                                                {"four", "--no-four-eyes", o.one_pair_of_eyes},
                                                {"head", "--head", !o.heads.empty()},
                                                {"sign", "--sign", !o.sign.empty()},
                                                {"trust", "--trust", !o.trust.empty()},
                                                {"csv", "--format csv", o.format == "csv"},
                                                {"amend", "--amend", !o.amend.empty()},
                                                {"source", "--source", !o.source.empty()},
                                                {"since", "--since", !o.since.empty()},
                                                {"until", "--until", !o.until.empty()},
                                                {"register", "--register", !o.register_folder.empty()},
                                                {"shared", "--shared", o.shared},
                                                {"today", "--today", !o.today.empty()},
                                                {"wait", "--wait-for-work", o.wait}}};
    const auto takes = [&](const char* word) {
        return action.takes.find(" " + std::string(word) + " ") != std::string_view::npos;
    };
    const std::string command = std::string("archive ") + action.name;
    for (const GivenOption& option : given) {
        if (option.given && !takes(option.word)) {
            refuse_usage(command, std::string(option.name) + " says nothing here", "see gumcert archive --help",
                         "leave it out");
        }
    }
    if (o.named.size() < action.least || o.named.size() > action.most) {
        refuse_usage(command, text::count_of(static_cast<std::int64_t>(o.named.size()), "name"),
                     std::string("takes ") + action.what, "see gumcert archive --help");
    }
    const bool of_files = std::string_view(action.name) == "verify" && !o.named.empty();
    if (o.store.empty() != of_files) {
        refuse_usage(command, o.store.empty() ? "--store is missing" : "--store and files of evidence",
                     "an action has one archive; evidence is verified without any",
                     o.store.empty() ? "name the file of the archive" : "leave one of them out");
    }
    if (!o.today.empty() && !evaluation::is_day_somewhere(o.today, time_now())) {
        refuse_usage(command, "--today " + o.today + (evaluation::is_day(o.today) ? "" : " is no day"),
                     "it is the day of the calendar, and the clock of this machine says " + time_now(),
                     "look at a calendar: set the clock right, or correct the day");
    }
    if (takes("by") && o.by.empty()) {
        refuse_usage(command, "--by is missing", "every entry of the log says who", "name the person who does this");
    }
    if (std::string_view(action.name) == "backup" && o.output.empty()) {
        refuse_usage(command, "--output is missing", "a backup is a new file", "name it with -o");
    }
    if (takes("to") && o.to.empty()) {
        refuse_usage(command, "--to is missing", "an archive is copied into a new one",
                     "name a new file, or an empty database as postgresql://…");
    }
    const std::string_view name = action.name;
    if (name == "backup" || name == "affected") {
        refuse_stdout("-o", o.output);
    }
    if (name == "init") {
        refuse_stdout("--store", o.store);
    }
    refuse_stdout("--to", o.to);
    if ((name == "withdraw" || name == "settings" || !o.why.empty()) && !archive::states_a_reason(o.why)) {
        refuse_usage(command, o.why.empty() ? "--why is missing" : "--why " + text::in_quotes(o.why) + " says nothing",
                     "what is withdrawn, or settled otherwise, has a reason, and a reason says something", "say why");
    }
}

}  // namespace

ExitCode use_archive(const ArchiveOptions& options, const CommonOptions& common) {
    const auto* const action =
        std::find_if(k_actions.begin(), k_actions.end(), [&](const Action& a) { return options.action == a.name; });
    if (action == k_actions.end()) {
        throw std::logic_error("an action that nothing does: " + options.action);
    }
    require_options(*action, options);
    return action->work(options, common);
}

}  // namespace gumcert::cli
