#include "archive/store/replay.h"

#include <optional>

#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

namespace {

LogEntry first_entry_of(Store& store) {
    std::optional<LogEntry> first;
    store.each_entry([&](const LogEntry& entry) {
        if (!first) {
            first = entry;
        }
    });
    if (!first) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-ARCHIVE-0007",
                            .where = store.name(),
                            .what = "the log is empty",
                            .rule = "the database of an archive is undamaged",
                            .action = "restore the newest backup that gumcert archive verify accepts"});
    }
    return *first;
}

}  // namespace

void replay(Store& from, const std::function<void(const LogEntry&, const Fill&)>& create, const Fill& finish) {
    from.read([&] {
        const LogEntry first = first_entry_of(from);
        create(first, [&](Store& to) {
            // Contents before the entries that name them.
            from.each_content([&](const Content& content) { to.put(content); });
            from.each_entry([&](const LogEntry& entry) {
                if (entry != first) {
                    to.append(entry);
                }
            });
            finish(to);
        });
    });
}

}  // namespace gumcert::archive
