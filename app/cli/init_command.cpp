#include "app/cli/init_command.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "evaluation/method_library.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

std::string list_of(const std::vector<evaluation::Method>& methods) {
    std::size_t longest = 0;
    for (const evaluation::Method& method : methods) {
        longest = std::max(longest, method.name.size());
    }
    std::string text = "Methods:\n\n";
    for (const evaluation::Method& method : methods) {
        text += fmt::format("  {:<{}}  {}\n", method.name, longest, method.title);
    }
    return text + "\nNext: gumcert init " + methods.front().name + " FOLDER\n";
}

}  // namespace

ExitCode init(const std::string& method, const std::string& folder, const std::string& share,
              const CommonOptions& common) {
    const std::vector<evaluation::Method> methods = evaluation::method_library(examples_folder(share));
    if (method.empty()) {
        write_to_stdout(list_of(methods));
        return done;
    }
    const auto found =
        std::find_if(methods.begin(), methods.end(), [&](const evaluation::Method& one) { return one.name == method; });
    if (found == methods.end()) {
        const std::string nearest = evaluation::nearest_method(methods, method);
        refuse_usage("init " + method, "is none of the methods that come with the program",
                     "a method is a folder with a job that runs; gumcert init lists them",
                     nearest.empty() ? "choose one of the list" : "did you mean " + nearest + "?");
    }
    refuse_stdout("DIR", folder);
    const std::filesystem::path place = folder.empty() ? method : folder;
    (void)begin_outputs({place / found->job}, common);  // nothing that stands there is replaced
    const std::vector<std::filesystem::path> written = evaluation::begin_with(*found, place);
    if (!common.quiet) {
        std::string text = found->title + "\n\nWritten:\n";
        for (const std::filesystem::path& file : written) {
            text += "  " + text::one_line(file.string()) + "\n";
        }
        write_to_stdout(text + "\nAll data are made up: put yours in their place.\nNext: gumcert run " +
                        text::one_line(written.front().string()) + "\n");
    }
    return done;
}

}  // namespace gumcert::cli
