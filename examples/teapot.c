// SPDX-License-Identifier: MIT
/* A copper teapot in plain OpenGL 1.1, which knows nothing of boards. Arrow keys turn it, Escape ends. */
#include <GL/glut.h>
#include <stdlib.h>

static GLfloat turned = 30, tilted = 20;

static void light(GLenum name, GLfloat x, GLfloat y, GLfloat z, GLfloat strength)
{
	const GLfloat position[4] = { x, y, z, 0 }; /* 0: a direction, as from the sun */
	const GLfloat colour[4] = { strength, strength, strength, 1 };

	glEnable(name);
	glLightfv(name, GL_POSITION, position);
	glLightfv(name, GL_DIFFUSE, colour);
	glLightfv(name, GL_SPECULAR, colour);
}

static void init(void)
{
	static const GLfloat ambient[4] = { 0.19f, 0.07f, 0.02f, 1 };
	static const GLfloat diffuse[4] = { 0.70f, 0.27f, 0.08f, 1 };
	static const GLfloat specular[4] = { 0.90f, 0.80f, 0.70f, 1 };

	glClearColor(0.1f, 0.1f, 0.12f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHTING);
	glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
	light(GL_LIGHT0, 0.5f, 0.8f, 1, 1);
	light(GL_LIGHT1, -1, 0.3f, 0.4f, 0.5f);
	glMaterialfv(GL_FRONT, GL_AMBIENT, ambient);
	glMaterialfv(GL_FRONT, GL_DIFFUSE, diffuse);
	glMaterialfv(GL_FRONT, GL_SPECULAR, specular);
	glMaterialf(GL_FRONT, GL_SHININESS, 60);
}

static void display(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	glTranslatef(0, 0, -5);
	glRotatef(tilted, 1, 0, 0);
	glRotatef(turned, 0, 1, 0);
	glFrontFace(GL_CW); /* glutSolidTeapot's triangles are clockwise */
	glutSolidTeapot(1);
	glFrontFace(GL_CCW);
	glutSwapBuffers();
}

static void reshape(int width, int height)
{
	GLdouble aspect = (GLdouble)width / height;

	glViewport(0, 0, width, height);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.85 * aspect, 0.85 * aspect, -0.85, 0.85, 3, 10);
	glMatrixMode(GL_MODELVIEW);
}

static void turn(int key, int x, int y)
{
	(void)x;
	(void)y;
	turned += 5.0f * (GLfloat)((key == GLUT_KEY_RIGHT) - (key == GLUT_KEY_LEFT));
	tilted += 5.0f * (GLfloat)((key == GLUT_KEY_DOWN) - (key == GLUT_KEY_UP));
	glutPostRedisplay();
}

static void type(unsigned char key, int x, int y)
{
	(void)x;
	(void)y;
	if (key == 27)
		exit(0);
}

int main(int argc, char **argv)
{
	glutInit(&argc, argv);
	glutInitDisplayMode(GLUT_RGB | GLUT_DOUBLE | GLUT_DEPTH);
	glutInitWindowPosition(0, 0);
	glutInitWindowSize(320, 240);
	glutCreateWindow("teapot");
	init();
	glutDisplayFunc(display);
	glutReshapeFunc(reshape);
	glutSpecialFunc(turn);
	glutKeyboardFunc(type);
	glutMainLoop();
	return 0;
}
