// Brings the files of schemas/, docs/job_keys.md and docs/laboratory_keys.md after the descriptions of jobs and records: write_schemas [ROOT]
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "jobs/schema/job_schema.h"
#include "jobs/schema/laboratory_schema.h"
#include "json/readable_json.h"
#include "reports/record/schema/record_schema.h"

namespace {

std::string content(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw std::runtime_error(path.string() + " cannot be read");
    }
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    if (!(file << text)) {
        throw std::runtime_error(path.string() + " cannot be written");
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::filesystem::path root = argc > 1 ? argv[1] : ".";
        const std::filesystem::path schema = root / "schemas/job-1.schema.json";
        write(schema, gumcert::jobs::with_described_definitions(content(schema)));
        write(root / "docs/job_keys.md", gumcert::jobs::page_of_job_keys());
        const nlohmann::ordered_json jobs = nlohmann::ordered_json::parse(content(schema));
        write(root / "schemas/laboratory-1.schema.json",
              gumcert::json::readable_json(gumcert::jobs::laboratory_schema(jobs)) + "\n");
        write(root / "docs/laboratory_keys.md", gumcert::jobs::page_of_laboratory_keys());
        write(root / "schemas/record-1.schema.json", gumcert::reports::record_schema_text());
    } catch (const std::exception& error) {
        std::cerr << "write_schemas: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
