#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gumcert::reports {

/// The table or figure of a view with that id, or null.
inline nlohmann::json block(const nlohmann::json& view, const char* kind, const std::string& id) {
    for (const nlohmann::json& section : view["sections"]) {
        for (const nlohmann::json& entry : section["blocks"]) {
            if (!entry[kind].empty() && entry[kind][0]["id"] == id) {
                return entry[kind][0];
            }
        }
    }
    return nullptr;
}

/// Texts of the cells of a table.
inline std::vector<std::vector<std::string>> rows_of(const nlohmann::json& view, const std::string& id) {
    std::vector<std::vector<std::string>> rows;
    const nlohmann::json table = block(view, "table", id);
    if (table.is_null()) {
        ADD_FAILURE() << "no table " << id;
        return rows;
    }
    for (const nlohmann::json& row : table["rows"]) {
        auto& cells = rows.emplace_back();
        for (const nlohmann::json& cell : row["cells"]) {
            cells.push_back(cell["text"]);
        }
    }
    return rows;
}

}  // namespace gumcert::reports
