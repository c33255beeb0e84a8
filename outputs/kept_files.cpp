#include "outputs/kept_files.h"

#include "gum/quantity/diagnostic.h"

namespace gumcert::outputs {

std::filesystem::path kept_place(const std::filesystem::path& output) {
    return output.parent_path() / "record-kept" / output.filename();
}

void make_or_keep(const std::function<void()>& make, const std::function<void()>& keep) {
    try {
        make();
    } catch (const gum::InputError&) {
        throw;  // exit code 3: nothing is written
    } catch (const gum::NoResultError& error) {
        keep();
        throw gum::StorageError(error.diagnostics());
    } catch (...) {
        keep();
        throw;
    }
}

}  // namespace gumcert::outputs
