#include "tests/archive/power_cut.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace gumcert::archive::test {

namespace {

constexpr std::size_t k_sector = 512;

class Chance {
public:
    explicit Chance(std::mt19937_64& random) : random_(random) {}
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
    bool with(double probability) { return static_cast<double>(random_() >> 11U) * 0x1p-53 < probability; }
    char byte() { return static_cast<char>(random_() & 0xFFU); }

private:
    std::mt19937_64& random_;
};

/// How much of what was not synchronised reaches the disk.
struct Loss {
    double kept = 0;       // of all sectors
    double spoiled = 0;    // of those that are kept: a piece, or rubbish
    double shortened = 0;  // of the files: their size did not reach the disk
};

Loss loss_of_chance(Chance& chance) {
    constexpr std::array<double, 6> k_kept = {0.0, 0.1, 0.5, 0.9, 0.99, 1.0};
    const double kept = k_kept.at(chance.below(k_kept.size()));
    const bool rough = chance.with(0.5);
    return {kept, rough ? 0.05 : 0, rough ? 0.3 : 0};
}

void put_sector(std::string& file, std::size_t at, std::string_view bytes, const Loss& loss, Chance& chance) {
    if (!chance.with(loss.kept)) {
        return;
    }
    std::string piece(bytes);
    if (chance.with(loss.spoiled)) {
        const std::size_t sound = chance.below(piece.size() + 1);
        if (chance.with(0.5)) {
            piece.resize(sound);
        } else {
            std::generate(piece.begin() + static_cast<std::ptrdiff_t>(sound), piece.end(),
                          [&] { return chance.byte(); });
        }
    }
    if (file.size() < at + piece.size()) {
        file.resize(at + piece.size());
    }
    std::copy(piece.begin(), piece.end(), file.begin() + static_cast<std::ptrdiff_t>(at));
}

void put_all(std::string& file, const DiskCall& call) {
    const auto at = static_cast<std::size_t>(call.at);
    if (call.kind == DiskCall::Kind::truncate) {
        file.resize(at);
        return;
    }
    if (file.size() < at + call.bytes.size()) {
        file.resize(at + call.bytes.size());
    }
    std::copy(call.bytes.begin(), call.bytes.end(), file.begin() + static_cast<std::ptrdiff_t>(at));
}

void put_some(std::string& file, const DiskCall& call, const Loss& loss, Chance& chance) {
    const auto begin = static_cast<std::size_t>(call.at);
    if (call.kind == DiskCall::Kind::truncate) {
        if (chance.with(loss.kept)) {
            file.resize(begin);
        }
        return;
    }
    const std::size_t end = begin + call.bytes.size();
    for (std::size_t at = begin; at < end;) {
        const std::size_t next = std::min(end, (at / k_sector + 1) * k_sector);
        put_sector(file, at, std::string_view(call.bytes).substr(at - begin, next - at), loss, chance);
        at = next;
    }
}

/// A file, whatever its name is.
struct Stored {
    std::string durable;
    std::vector<const DiskCall*> unsynced;

    void sync() {
        for (const DiskCall* const call : unsynced) {
            put_all(durable, *call);
        }
        unsynced.clear();
    }
    [[nodiscard]] std::string after_loss(const Loss& loss, Chance& chance) const {
        std::string bytes = durable;
        for (const DiskCall* const call : unsynced) {
            put_some(bytes, *call, loss, chance);
        }
        if (bytes.size() > durable.size() && chance.with(loss.shortened)) {
            bytes.resize(durable.size() + chance.below(bytes.size() - durable.size()));
        }
        return bytes;
    }
};

class Disk {
public:
    explicit Disk(const DiskImage& before) {
        for (const auto& [name, bytes] : before) {
            names_[name] = {static_cast<int>(files_.size())};
            files_.push_back({bytes, {}});
        }
    }

    void take(const DiskCall& call, Chance& chance) {
        std::vector<int>& meanings = names_.try_emplace(call.file, std::vector<int>{k_none}).first->second;
        switch (call.kind) {
            case DiskCall::Kind::create:
                meanings.push_back(static_cast<int>(files_.size()));
                files_.emplace_back();
                return;
            case DiskCall::Kind::remove:
                meanings.push_back(k_none);
                return;
            case DiskCall::Kind::sync_folder:
                for (auto& [name, all] : names_) {
                    all.erase(all.begin(), all.end() - 1);
                }
                return;
            case DiskCall::Kind::write:
            case DiskCall::Kind::truncate:
                now(meanings).unsynced.push_back(&call);
                return;
            case DiskCall::Kind::sync:
                now(meanings).sync();
                return;
            case DiskCall::Kind::failed_sync: {
                // A system may forget what it could not write: the next sync, which succeeds, does not bring it.
                Stored& file = now(meanings);
                file.durable = file.after_loss(loss_of_chance(chance), chance);
                file.unsynced.clear();
                return;
            }
        }
    }

    [[nodiscard]] DiskImage after_loss(const Loss& loss, Chance& chance) const {
        DiskImage image;
        for (const auto& [name, meanings] : names_) {
            const int meaning = loss.kept == 1.0 ? meanings.back() : meanings.at(chance.below(meanings.size()));
            if (meaning != k_none) {
                image[name] = files_.at(static_cast<std::size_t>(meaning)).after_loss(loss, chance);
            }
        }
        return image;
    }

private:
    static constexpr int k_none = -1;
    std::vector<Stored> files_;
    std::map<std::string, std::vector<int>> names_;  // the first one is durable, the last one is how it is now

    Stored& now(const std::vector<int>& meanings) { return files_.at(static_cast<std::size_t>(meanings.back())); }
};

}  // namespace

DiskImage image_after_power_cut(const DiskImage& before, const std::vector<DiskCall>& calls, std::size_t number,
                                std::mt19937_64& random) {
    Chance chance(random);
    Disk disk(before);
    for (std::size_t i = 0; i < number; ++i) {
        disk.take(calls.at(i), chance);
    }
    return disk.after_loss(loss_of_chance(chance), chance);
}

DiskImage read_image(const std::filesystem::path& folder) {
    DiskImage image;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (const std::string name = entry.path().filename().string(); !name.ends_with("-shm")) {
            std::ifstream stream(entry.path(), std::ios::binary);
            image[name] = {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        }
    }
    return image;
}

void write_image(const DiskImage& image, const std::filesystem::path& folder, std::mt19937_64& random) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    for (const auto& [name, bytes] : image) {
        std::ofstream(folder / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    Chance chance(random);
    if (chance.with(0.5)) {
        for (const auto& [name, bytes] : image) {
            if (name.ends_with("-wal")) {
                const std::string rubbish(32768, chance.byte());
                std::ofstream(folder / (name.substr(0, name.size() - 4) + "-shm"), std::ios::binary) << rubbish;
            }
        }
    }
}

}  // namespace gumcert::archive::test
