// Brings docs/audit_rules.md after the rules of the audit: write_audit_rules [ROOT]
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "audit/rules/rules_page.h"

int main(int argc, char** argv) {
    try {
        const std::filesystem::path path = std::filesystem::path(argc > 1 ? argv[1] : ".") / "docs/audit_rules.md";
        std::ofstream file(path, std::ios::binary);
        if (!(file << gumcert::audit::rules_page(gumcert::audit::all_rules(), gumcert::audit::rules_left_out()))) {
            throw std::runtime_error(path.string() + " cannot be written");
        }
    } catch (const std::exception& error) {
        std::cerr << "write_audit_rules: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
