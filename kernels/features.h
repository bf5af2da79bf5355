/* The list of compile-time options: what a program can leave out. Everything is on by default; the program
 * with everything on renders every scene, and a specialised one gives the same bits. */
#ifndef TRIAD_FEATURES_H
#define TRIAD_FEATURES_H

#ifndef TRIAD_INSTANCES /* some mesh is placed by instances: a second level of trees */
#define TRIAD_INSTANCES 1
#endif
#ifndef TRIAD_ALPHA_TEST /* some alphaMode is MASK or BLEND: rays test coverage */
#define TRIAD_ALPHA_TEST 1
#endif
#ifndef TRIAD_TEXTURES /* some material uses a texture */
#define TRIAD_TEXTURES 1
#endif
#ifndef TRIAD_TEXTURE_LEVELS /* some texture of colours has a pyramid of means (needs TRIAD_TEXTURES) */
#define TRIAD_TEXTURE_LEVELS 1
#endif
#ifndef TRIAD_NORMAL_MAPS /* some material has a normal map (needs TRIAD_TEXTURES) */
#define TRIAD_NORMAL_MAPS 1
#endif
#ifndef TRIAD_VERTEX_COLOURS /* some geometry has COLOR_0 */
#define TRIAD_VERTEX_COLOURS 1
#endif
#ifndef TRIAD_SPECULAR /* some material reflects other than by Lambert's law */
#define TRIAD_SPECULAR 1
#endif
#ifndef TRIAD_TRANSMISSION /* some material transmits */
#define TRIAD_TRANSMISSION 1
#endif
#ifndef TRIAD_DISPERSION /* some body refracts every wavelength otherwise, or every path has a wavelength */
#define TRIAD_DISPERSION 1
#endif
#ifndef TRIAD_LIGHT_SPECTRA /* some light has a spectrum of its own, and paths have wavelengths */
#define TRIAD_LIGHT_SPECTRA 1
#endif
#ifndef TRIAD_PRIORITIES /* bodies that overlap may differ in priority */
#define TRIAD_PRIORITIES 1
#endif
#ifndef TRIAD_CLEARCOAT /* some material has KHR_materials_clearcoat */
#define TRIAD_CLEARCOAT 1
#endif
#ifndef TRIAD_SHEEN /* some material has KHR_materials_sheen */
#define TRIAD_SHEEN 1
#endif
#ifndef TRIAD_ANISOTROPY /* some material has KHR_materials_anisotropy (needs TRIAD_SPECULAR) */
#define TRIAD_ANISOTROPY 1
#endif
#ifndef TRIAD_IRIDESCENCE /* some material has KHR_materials_iridescence (needs TRIAD_SPECULAR) */
#define TRIAD_IRIDESCENCE 1
#endif
#ifndef TRIAD_DIFFUSE_TRANSMISSION /* some material has KHR_materials_diffuse_transmission */
#define TRIAD_DIFFUSE_TRANSMISSION 1
#endif
#ifndef TRIAD_UNLIT /* some material is KHR_materials_unlit */
#define TRIAD_UNLIT 1
#endif
#ifndef TRIAD_TRIANGLE_LIGHTS /* some triangle emits */
#define TRIAD_TRIANGLE_LIGHTS 1
#endif
#ifndef TRIAD_NEAR_LIGHTS /* some triangle light is large beside its distance to what it lights \
                           * (needs TRIAD_TRIANGLE_LIGHTS) */
#define TRIAD_NEAR_LIGHTS 1
#endif
#ifndef TRIAD_PUNCTUAL_LIGHTS /* there is a point, spot or directional light */
#define TRIAD_PUNCTUAL_LIGHTS 1
#endif
#ifndef TRIAD_ENVIRONMENT_MAP /* the environment is a map (else one colour, possibly black) */
#define TRIAD_ENVIRONMENT_MAP 1
#endif
#ifndef TRIAD_LIGHT_TREE /* there are many lights: a tree picks them for the point that they light */
#define TRIAD_LIGHT_TREE 1
#endif
#ifndef TRIAD_LENS /* the camera has an aperture */
#define TRIAD_LENS 1
#endif
#ifndef TRIAD_INDEPENDENT_SAMPLES /* samples may be asked to be independent of each other instead of Sobol's \
                                   */
#define TRIAD_INDEPENDENT_SAMPLES 1
#endif
#ifndef TRIAD_RAY_STARTS /* rays start elsewhere in their bins than jittered */
#define TRIAD_RAY_STARTS 1
#endif
#ifndef TRIAD_PHOTONS /* photons bring the light that mirrors and glass throw onto other surfaces */
#define TRIAD_PHOTONS 1
#endif
#ifndef TRIAD_GATHER /* photons are gathered too, where mirrors, glass or a bounce come before them \
                      * (needs TRIAD_PHOTONS) */
#define TRIAD_GATHER 1
#endif
#ifndef TRIAD_BINS /* the film has more than one bin per pixel */
#define TRIAD_BINS 1
#endif

#endif
