/* A C program that uses the installed library. It returns from main with everything still open and a thread
 * in a wait, so that the library has to clean up. */
#include <camera_director/camera_director.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(const char* what, cdir_status status) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", what, cdir_last_error());
    exit(EXIT_FAILURE);
}

static void* wait_forever(void* argument) {
    const cdir_observer observer = *(const cdir_observer*)argument;
    (void)cdir_observer_wait(observer, -1);
    return NULL;
}

int main(void) {
    static cdir_observer observer;
    cdir_context_options options = cdir_context_options_default();
    cdir_match_info info = cdir_match_info_default();
    cdir_shot_request request = cdir_shot_request_default();
    cdir_pose_frame frame = cdir_pose_frame_default();
    cdir_context context;
    cdir_match match;
    pthread_t thread;

    options.domain = 83;
    strcpy(info.match_id, "consumer");
    strcpy(info.map_name, "map");
    check("context", cdir_context_open(&options, &context));
    check("match", cdir_match_open(context, &info, NULL, 0, &match));
    check("observer", cdir_observer_open(context, "consumer", "c", NULL, &observer));
    check("request", cdir_observer_request(observer, &request));
    check("poses", cdir_match_publish_poses(match, &frame));
    check("wait", cdir_observer_wait(observer, 1000000));
    check("poll", cdir_observer_poll(observer, NULL));
    if (cdir_observer_match_info(observer, &info, NULL, 0, NULL) != CDIR_NO_DATA) return EXIT_FAILURE;
    if (pthread_create(&thread, NULL, wait_forever, &observer) != 0) return EXIT_FAILURE;
    return pthread_detach(thread);
}
