/* meeting.c: a bar is thrown over a wall, grazes it, and hits the next one: when? */
#include <froe/kinetic.h>
#include <stdio.h>

static bool tell(void *user, const froe_contact *c) {
    (void)user;
    printf("%u meets %u at %.15g%s%.15g\n", c->a, c->b, c->begin[0], c->instant ? " and no longer than " : " until ",
           c->end[0]);
    return true;
}

int main(void) {
    const size_t starts[] = {0, 1, 2, 4, 6, 7, 8}; /* walls stand still; each end of the bar flies on one parabola */
    const double times[] = {0, 0, 0, 4, 0, 4, 0, 0};
    const double points[] = {3, 0, 3, 3, 0, 0, 8, 0, 1, 0, 9, 0, 7, 0, 7, 3};
    const double controls[] = {0, 0, 0, 0, 4, 8, 0, 0, 5, 8, 0, 0, 0, 0, 0, 0};
    froe_motion_options window = froe_motion_defaults();
    window.begin = 0, window.end = 4;
    froe_moving batch = froe_moving_defaults();
    batch.vertex_count = 6, batch.starts = starts, batch.times = times, batch.coords = points;
    batch.controls = controls, batch.count = 3;
    froe_motion *motion = NULL;
    froe_diagnostic why = {0};
    if (froe_motion_new(&window, NULL, &motion, &why) || froe_motion_add(motion, &batch, &why) ||
        froe_motion_contacts(motion, NULL, tell, NULL, &why))
        return fprintf(stderr, "meeting: %s\n", why.message), 1;
    froe_motion_free(motion);
}
