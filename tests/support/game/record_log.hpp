// A growing file of records.
#pragma once

#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

namespace camdir::test {

template <class Record>
class RecordLog {
  public:
    explicit RecordLog(std::filesystem::path file) : file_(std::move(file)) {}

    // All complete records so far.
    const std::vector<Record>& read() {
        std::ifstream stream(file_, std::ios::binary);
        stream.seekg(static_cast<std::streamoff>(records_.size() * sizeof(Record)));
        Record record;
        while (stream.read(reinterpret_cast<char*>(&record), sizeof record))
            records_.push_back(record);
        return records_;
    }

  private:
    std::filesystem::path file_;
    std::vector<Record> records_;
};

}  // namespace camdir::test
