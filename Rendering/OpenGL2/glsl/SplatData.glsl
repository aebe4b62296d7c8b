// A splat from the vertex to its pixels. Camera space: x to the right, y up, z along the
// line of sight, world units; pixels: the viewport's, y up. Twin of RasterBatch.
// POINTFRONT_SHAPE     0 square, 1 disc, 2 affine ellipse, 3 exact ellipse, 4 sphere, 5 wall
// POINTFRONT_PARALLEL  rays are parallel
// POINTFRONT_PASS      1 who is seen, 2 weights and colours of what is not behind
// POINTFRONT_COLOUR    0 one colour, 1 colours, 2 values for the table, 3 elevation
// POINTFRONT_MARKED    alpha of a colour is the number of the style that draws the point
// POINTFRONT_SHAPED    normals and codes of radii are there; POINTFRONT_NORMALS: normals count
// POINTFRONT_RADIUS    0 pixels, 1 world units, 2 what closes the node, 3 codes, 4 a column's
// POINTFRONT_STAND_IN  of a refining view: an id is the number of the point's node
// POINTFRONT_FOLLOWS   only what is seen before what was drawn earlier
// POINTFRONT_LIT, POINTFRONT_PICKING, POINTFRONT_QUADS
