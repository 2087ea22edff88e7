// A match of four seconds, written to files.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "base/file.hpp"
#include "support/freespace_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {

// A hall of 30 x 30 x 8 m with a mesh of balls in its middle. Player 0 walks in a circle of 2.5 m round
// player 1, who looks along x and kills player 0 in front of them.
class HallMatch : public testing::Test {
  protected:
    void SetUp() override {
        write_map();
        write_freespace();
        write_trace(0.0);
        ASSERT_TRUE(write_file(events_, "t_ms,event,player,other\n3000,kill,1,0\n"));
    }

    // All of it `aside` metres off along x.
    void write_trace(double aside, int milliseconds = 4000) const {
        std::ostringstream trace;
        trace << "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
        for (int t = 0; t <= milliseconds; t += 16) {
            const double angle = 1e-3 * t;
            trace << t << ",0," << aside + 2.5 * std::sin(angle) << ',' << -2.5 * std::cos(angle) << ",3.4,0,"
                  << angle * 180.0 / std::numbers::pi << ",0,0,0,0,0.6,0,0,1\n"
                  << t << ",1," << aside << ",0,3.4,0,0,0,0,0,0,0.6,0,0,1\n";
        }
        ASSERT_TRUE(write_file(trace_, trace.str()));
    }

    void write_freespace(const std::vector<freespace::FixedShot>& fixed_shots = {}) const {
        freespace::Contents contents = test::empty_contents();
        contents.metadata.map_name = "hall";
        contents.metadata.metres_per_unit = 1.0F;
        contents.metadata.d0 = 0.4F;
        contents.vertices = {{-8, -8, 4, 3.5F}, {8, -8, 4, 3.5F}, {8, 8, 4, 3.5F}, {-8, 8, 4, 3.5F}};
        contents.triangles = {{0, 1, 2}, {0, 2, 3}};
        contents.spawn_points = {{Vec3f(0, 0, 4), 0.0F}};
        contents.fixed_shots = fixed_shots;
        ASSERT_TRUE(write_file(vfs_, freespace::encode(contents)));
    }

    test::TemporaryFolder folder_;
    const std::string map_ = folder_ / "hall.obj";
    std::string vfs_ = folder_ / "hall.vfs";
    const std::string trace_ = folder_ / "trace.csv";
    const std::string events_ = folder_ / "events.csv";

  private:
    void write_map() const {
        std::ostringstream obj;
        for (int i = 0; i < 8; ++i)
            obj << "v " << ((i & 1) != 0 ? 15 : -15) << ' ' << ((i & 2) != 0 ? 15 : -15) << ' '
                << ((i & 4) != 0 ? 8 : 0) << '\n';
        for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"})
            obj << "f " << face << '\n';
        ASSERT_TRUE(write_file(map_, obj.str()));
    }
};

}  // namespace camdir
