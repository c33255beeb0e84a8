#include "archive/head.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "json/canonical_json.h"
#include "json/strict_parser.h"

namespace gumcert::archive {

namespace {

constexpr const char* k_head_schema = "gumcert/archive-head/1";
constexpr std::size_t k_hash_bytes = 32;
constexpr std::size_t k_signature_bytes = 64;

[[noreturn]] void refuse_head(const std::string& name, const std::string& key) {
    throw gum::InputError(
        gum::Diagnostic{.code = "GC-ARCHIVE-0049",
                        .where = name,
                        .what = key.empty() ? "is no head of an archive" : key + " is missing or has another form",
                        .rule = "a head is the JSON that gumcert archive head writes",
                        .action = "name a file that gumcert archive head has written"});
}

std::string bytes_at(const nlohmann::json& object, const char* key, std::size_t size, const std::string& name) {
    const auto found = object.find(key);
    if (found != object.end() && found->is_string()) {
        std::optional<std::string> bytes = encoding::bytes_from_hexadecimal(found->get_ref<const std::string&>());
        if (bytes && bytes->size() == size) {
            return std::move(*bytes);
        }
    }
    refuse_head(name, key);
}

nlohmann::json unsigned_json(const Head& head) {
    return {{"schema", k_head_schema},
            {"archive", encoding::hexadecimal(head.archive)},
            {"size", head.size},
            {"root", encoding::hexadecimal(head.root)},
            {"chain", encoding::hexadecimal(head.chain)},
            {"at", head.at}};
}

}  // namespace

void WalkedLog::add(const LogEntry& entry) {
    if (tree_.size() == 0) {
        head_.archive = entry.hash;
    }
    tree_.add(entry.hash);
    head_.size = static_cast<std::int64_t>(tree_.size());
    head_.chain = entry.hash;
    head_.at = entry.at;
}

Head WalkedLog::head() const {
    Head head = head_;
    head.root = tree_.root();
    return head;
}

std::string signed_bytes(const Head& head) {
    return gumcert::json::canonical_json(unsigned_json(head));
}

std::string to_json(const Head& head) {
    nlohmann::json object = unsigned_json(head);
    if (head.signature) {
        object["signature"] = {{"algorithm", "Ed25519"},
                               {"public_key", encoding::hexadecimal(head.signature->public_key)},
                               {"value", encoding::hexadecimal(head.signature->value)}};
    }
    return gumcert::json::canonical_json(object);
}

Head head_from_json(std::string_view text, const std::string& name) {
    const std::optional<nlohmann::json> object = gumcert::json::parse_faultless(text, {});
    if (!object || !object->is_object() || object->value("schema", nlohmann::json()) != k_head_schema) {
        refuse_head(name, "");
    }
    Head head;
    head.archive = bytes_at(*object, "archive", k_hash_bytes, name);
    head.root = bytes_at(*object, "root", k_hash_bytes, name);
    head.chain = bytes_at(*object, "chain", k_hash_bytes, name);
    const nlohmann::json size = object->value("size", nlohmann::json());
    const nlohmann::json at = object->value("at", nlohmann::json());
    if (!size.is_number_integer() || size.get<std::int64_t>() < 1) {
        refuse_head(name, "size");
    }
    if (!at.is_string()) {
        refuse_head(name, "at");
    }
    head.size = size.get<std::int64_t>();
    head.at = at.get<std::string>();
    if (const auto signature = object->find("signature"); signature != object->end()) {
        if (!signature->is_object() || signature->value("algorithm", nlohmann::json()) != "Ed25519") {
            refuse_head(name, "signature");
        }
        head.signature = Head::Signature{bytes_at(*signature, "public_key", k_hash_bytes, name),
                                         bytes_at(*signature, "value", k_signature_bytes, name)};
    }
    return head;
}

}  // namespace gumcert::archive
