/* Stage `start`: samples of the picture become paths. */
#ifndef TRIAD_PATH_START_H
#define TRIAD_PATH_START_H

#include "path/state.h"
#include "shading/sample.h"

/* A sample of a pixel, and the camera's ray. */
typedef struct CameraSample {
    SampleName name;
    SampleWeight weight; /* of what comes along the ray */
    Ray ray;
} CameraSample;

/* Sample s of the pixel (x, y) of the crop. */
TRIAD_FUNCTION CameraSample camera_sample(const Scene* scene, const Frame* frame, uint x, uint y, ulong s) {
    /* samples are named by the pixel's index in the full picture */
    const uint pixel = (frame->crop[1] + y) * (uint)frame->camera.pixels[0] + frame->crop[0] + x;
    CameraSample sample;
    sample.name = sample_name(frame, pixel, s);
    sample.ray = sample_camera_ray(frame, scene->ray_filter, &sample.name, x, y, &sample.weight);
    return sample;
}

TRIAD_FUNCTION PathState path_start(const Scene* scene, const CameraSample* sample) {
    return path_state(&sample->name.path, sample->ray, path_colour_start(scene, &sample->name.path));
}

#endif
