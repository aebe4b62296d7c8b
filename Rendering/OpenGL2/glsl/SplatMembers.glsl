  flat vec4 centre;    // screen x, y; depth; radius in world units
  flat vec4 form;      // disc: 1 / radius^2; ellipse: xx, xy, yy; exact: normal, facing, 1 / r^2;
                       // wall: unit vector to the right, height
  flat vec4 slope;     // exact, sphere, wall: the centre's direction; ellipse: depth per pixel,
                       // then that direction
  flat vec4 rectangle; // pixels: left, low, right, high
  flat vec4 colour;
  flat vec3 normal;    // camera space, any length; 0: none
  flat vec2 id;        // low and high 24 bits
