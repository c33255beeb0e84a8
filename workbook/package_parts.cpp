#include "workbook/package_parts.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <new>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/small_letters.h"
#include "text/visible_text.h"
#include "workbook/limits.h"

namespace gumcert::workbook {

namespace {

std::string folded_name(std::string_view text) {
    std::string folded = text::in_small_letters(text);
    std::replace(folded.begin(), folded.end(), '\\', '/');
    return folded;
}

gum::InputError damaged(const std::string& where, const std::string& what) {
    return gum::InputError(
        gum::Diagnostic{.code = "GC-WORKBOOK-0004",
                        .where = where,
                        .what = what,
                        .rule = "an .xlsx file is a ZIP archive of parts with names of their own, stored or deflated",
                        .action = "ask for an undamaged file, or store the workbook again with a spreadsheet program"});
}

gum::InputError missing_part(const std::string& where, const std::string& what) {
    return gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0010",
                                           .where = where,
                                           .what = what,
                                           .rule = "what a workbook is made of stands in its own file",
                                           .action = "store the workbook again with a spreadsheet program"});
}

/// How many entries the archive can have at most: each begins with this mark.
std::size_t count_of_entries(std::string_view bytes) {
    std::size_t count = 0;
    constexpr std::string_view k_mark = "PK\x01\x02";
    for (std::size_t at = bytes.find(k_mark); at != std::string_view::npos;
         at = bytes.find(k_mark, at + k_mark.size())) {
        ++count;
    }
    return count;
}

struct DiscardArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};

struct CloseEntry {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

/// Memory that libzip could not have says nothing of the archive.
void tell_memory(int code_of_libzip) {
    if (code_of_libzip == ZIP_ER_MEMORY) {
        throw std::bad_alloc();
    }
}

}  // namespace

struct PackageParts::Archive {
    std::string where;
    std::unique_ptr<zip_t, DiscardArchive> zip;
    std::map<std::string, zip_uint64_t, std::less<>> entries;
    std::size_t left = k_largest_unpacked;
};

PackageParts::PackageParts(std::string_view bytes, std::string where) : archive_(std::make_unique<Archive>()) {
    archive_->where = std::move(where);
    if (count_of_entries(bytes) > k_most_parts) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0006",
                                              .where = archive_->where,
                                              .what = "an archive of more than 10000 parts",
                                              .rule = "workbooks are read up to 10000 parts",
                                              .action = "store what is to be looked at as a workbook of its own"});
    }
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source != nullptr) {
        archive_->zip.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
        if (!archive_->zip) {
            zip_source_free(source);
        }
    }
    const int code = zip_error_code_zip(&error);
    zip_error_fini(&error);
    if (!archive_->zip) {
        tell_memory(code);
        throw damaged(archive_->where, "the archive cannot be opened");
    }
    const zip_int64_t count = zip_get_num_entries(archive_->zip.get(), 0);
    for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(std::max<zip_int64_t>(count, 0)); ++i) {
        const char* const name = zip_get_name(archive_->zip.get(), i, ZIP_FL_ENC_RAW);
        if (name == nullptr) {
            tell_memory(zip_error_code_zip(zip_get_error(archive_->zip.get())));
        }
        if (name == nullptr || *name == '\0') {
            throw damaged(archive_->where, "a part without a name");
        }
        const std::string folded = folded_name(name);
        if (!archive_->entries.emplace(folded.substr(folded.front() == '/' ? 1 : 0), i).second) {
            throw damaged(archive_->where, "two parts of the name " + text::in_quotes(name));
        }
    }
}

PackageParts::~PackageParts() = default;

bool PackageParts::has(const std::string& name) const {
    return archive_->entries.contains(folded_name(name));
}

std::vector<std::string> PackageParts::names() const {
    std::vector<std::string> names;
    for (const auto& [name, index] : archive_->entries) {
        names.push_back(name);
    }
    return names;
}

std::string PackageParts::read(const std::string& name) {
    const auto found = archive_->entries.find(folded_name(name));
    if (found == archive_->entries.end()) {
        throw missing_part(archive_->where, "the part " + text::in_quotes(name) + " is missing");
    }
    zip_stat_t stat;
    zip_stat_init(&stat);
    const std::string part = archive_->where + "#" + text::visible(name);
    if (zip_stat_index(archive_->zip.get(), found->second, 0, &stat) != 0 || (stat.valid & ZIP_STAT_COMP_METHOD) == 0 ||
        (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)) {
        throw damaged(part, "a part that is packed in a way that workbooks do not use");
    }
    const std::unique_ptr<zip_file_t, CloseEntry> file(zip_fopen_index(archive_->zip.get(), found->second, 0));
    if (!file) {
        tell_memory(zip_error_code_zip(zip_get_error(archive_->zip.get())));
        throw damaged(part, "a part that cannot be opened");
    }
    std::string bytes;
    std::array<char, 65536> buffer{};
    for (;;) {
        const zip_int64_t count = zip_fread(file.get(), buffer.data(), buffer.size());
        if (count < 0) {
            tell_memory(zip_error_code_zip(zip_file_get_error(file.get())));
            throw damaged(part, "a part that cannot be unpacked");
        }
        if (count == 0) {
            return bytes;
        }
        if (static_cast<std::size_t>(count) > archive_->left) {
            throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0005",
                                                  .where = part,
                                                  .what = "parts of more than 200 MB",
                                                  .rule = "workbooks are read up to 200 MB unpacked",
                                                  .action = "store what is to be looked at as a workbook of its own"});
        }
        archive_->left -= static_cast<std::size_t>(count);
        bytes.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

std::string part_name(std::string_view base, std::string_view target, const std::string& where) {
    const std::string folded = folded_name(target);
    std::vector<std::string> folders;
    const auto walk = [&](std::string_view path) {
        for (std::size_t begin = 0; begin <= path.size();) {
            const std::size_t end = std::min(path.find('/', begin), path.size());
            const std::string_view step = path.substr(begin, end - begin);
            if (step == "..") {
                if (folders.empty()) {
                    throw missing_part(where, "a part outside of the file, " + text::in_quotes(target));
                }
                folders.pop_back();
            } else if (!step.empty() && step != ".") {
                folders.emplace_back(step);
            }
            begin = end + 1;
        }
    };
    if (!folded.starts_with('/')) {
        const std::size_t slash = base.rfind('/');
        walk(slash == std::string_view::npos ? "" : base.substr(0, slash));
    }
    walk(folded);
    std::string name;
    for (const std::string& folder : folders) {
        name += (name.empty() ? "" : "/") + folder;
    }
    return name;
}

}  // namespace gumcert::workbook
